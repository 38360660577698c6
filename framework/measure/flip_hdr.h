// SPDX-License-Identifier: MIT
// HDR-FLIP (Andersson, Nilsson, Shirley, Akenine-Möller 2021, "Visualizing Errors in Rendered High
// Dynamic Range Images"): the largest FLIP in each pixel over a range of exposures, each shown
// through an ACES-like tone curve.
//
// The paper ends the range at the exposure that makes the median luminance 0.85. The median of a
// caustic layer is 0, as most of it is black; ours ends at the luminance that 90 % of the flux
// exceeds. Like the paper's, the range follows from the reference alone.
#pragma once

#include "framework/measure/flip.h"
#include "framework/measure/reference_scale.h"

namespace kaustik::measure {

// Evenly spaced, both ends included; an exposure of e stops multiplies the image by 2^e.
struct ExposureRange {
    double start = 0.0;  // stops
    double stop = 0.0;
    int count = 1;  // at least 1; 1 is `start` alone

    [[nodiscard]] double at(int index) const;
};

// Krzysztof Narkowicz's fit of the ACES curve with the input scaled by 0.6, clamped to [0,1]; the
// paper's choice. `linear` at least 0, and however large.
[[nodiscard]] double toneMap(double linear);

// The exposures from that at which the brightest luminance is shown as 0.85 to that at which
// `scale.faint` is; as many as in the paper, max(2, ceil(stop - start)). `scale` is not black.
[[nodiscard]] ExposureRange defaultExposures(const ReferenceScale& scale);

// The largest FLIP over the exposures, in each pixel. Exposures run on all processors; the result
// is the same for any number of them.
[[nodiscard]] Plane<float> hdrFlipMap(const ImagePair& pair, const ExposureRange& exposures,
                                      double pixelsPerDegree = kFlipPixelsPerDegree);

}  // namespace kaustik::measure
