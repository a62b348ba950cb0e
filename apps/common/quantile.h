#pragma once
/// Medians and other ranks of measured values.
#include <vector>

namespace manzana::apps {

/// The smallest value that at least the fraction p of the values reach down to (nearest rank), 0 < p <= 1; the median
/// is quantile(values, 0.5). 0 without values.
double quantile(std::vector<double> values, double p);

}  // namespace manzana::apps
