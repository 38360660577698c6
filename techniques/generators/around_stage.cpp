// SPDX-License-Identifier: MIT
#include "techniques/generators/around_stage.h"

#include <memory>

namespace kaustik {

const std::vector<SurfacesAround>& surfacesAround(FrameBuilder& frame, const Geometry& geometry) {
    return *frame.once<std::vector<SurfacesAround>>("around", [&] {
        return std::make_shared<std::vector<SurfacesAround>>(frame.run<AroundStage>(geometry));
    });
}

}  // namespace kaustik
