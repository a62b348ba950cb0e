#pragma once
/// How far a picture of a plant is from its reference. No single measure decides: pruning without compensation wins by
/// structure and loses the crown's cover; so all stand side by side.
///   const ImageError error = image_error(reference, candidate);
/// Structure is judged on sRGB luma before a sky, as a mean over the plants' pixels (of either picture, and 5 more all
/// round): over a whole frame the empty sky would drown it, in a crop the border would decide.
#include <vector>

#include "apps/foliage_benchmark/picture.h"

namespace manzana::foliage_benchmark {

struct ImageError {
  double cover = 1;       ///< what the candidate covers over what the reference does
  double iou = 1;         ///< of the pixels covered by half: intersection over union
  double silhouette = 0;  ///< sum of differences of coverage over the reference's coverage
  double colour = 0;      ///< root mean square over r, g, b of the difference of mean colours of the plants, linear
  double ssim = 1;        ///< [Wang 2004] Gaussian window of 1.5 pixels
  double gmsd = 0;        ///< [Xue 2014] standard deviation of gradient similarity, at half the size
  double psnr = 99;       ///< dB, of sRGB; at most 99
};

/// Asserts that both have the same size.
ImageError image_error(const Picture& reference, const Picture& candidate);

/// How much a picture steps from one frame to the next: the mean, the value that one pixel in a thousand exceeds, and
/// the most, of the largest difference of an sRGB channel, over the plants' pixels of either.
struct Step {
  double mean = 0, strong = 0, most = 0;
};
Step step_between(const Picture& before, const Picture& after);

/// Which pixels structure is judged on.
std::vector<bool> judged_pixels(const Picture& a, const Picture& b, int grown_by);

}  // namespace manzana::foliage_benchmark
