// SPDX-License-Identifier: MIT
#include "tests/fuzz/seeds.h"

namespace kaustik::fuzz {

reference::PixelSums smallSums() {
    reference::PixelSums sums(2, 1, 1, 1.0, 1.0);
    reference::BatchResult batch;
    batch.energy.watts[transport::kAccountEmitted] = 1.0;
    batch.photons = 100;
    for (const double scale : {1.0, 1.5}) {
        batch.values = {scale, 0.25 * scale, 0.0, 2.0, 0.0, 1.0};
        sums.add(sums.batchCount(), batch);
    }
    return sums;
}

reference::Reference smallReference() {
    const reference::PixelSums sums = smallSums();
    reference::Reference result;
    result.key = kSumsKey;
    result.scene = "smallest";
    result.request.estimator = reference::Estimator::sppm;
    result.request.width = sums.width();
    result.request.height = sums.height();
    result.irradiance = sums.meanImage(0);
    result.irradianceError = sums.standardErrorImage(0);
    result.causticView = result.irradiance;
    result.causticViewError = result.irradianceError;
    result.energy = sums.energy();
    result.photons = sums.photons();
    result.batches = sums.batchCount();
    result.relativeError = sums.relativeStandardError(0);
    return result;
}

}  // namespace kaustik::fuzz
