#pragma once
/// What many measured values come to. Of times ranks only, because what disturbs a measurement has no mean.
#include <span>
#include <vector>

namespace manzana::apps {

/// The middle value, or the mean of the two in the middle. Asserts that there is one.
double median(std::vector<double> values);

/// The same for ratios: a/b and b/a get answers that are each other's inverse, because it is the median of the
/// logarithm.
double median_ratio(std::vector<double> ratios);

struct Interval {
  double low = 0, high = 0;
};
/// Holds the median of what the values were drawn from with at least 95 %, whatever its distribution: two order
/// statistics. Under six values: all there is, with less than that. Asserts that there is one.
/// [Thompson, Annals of Mathematical Statistics 7 (1936), p. 122]
Interval median_interval(std::vector<double> values);

/// A mean, and by how much that of what the values were drawn from may differ, with 95 %: Student's t. Of one value:
/// infinity. Asserts that there is one.
struct Mean {
  double mean = 0, within = 0;
};
Mean mean_of(std::span<const double> values);

}  // namespace manzana::apps
