// SPDX-License-Identifier: MIT
// specular.auto: what the scene needs of the other two. specular.split where a sheet of water or
// glass sends much of its light back to a receiver (scene/light_paths.h), else specular.interface.
#include <fmt/format.h>

#include "framework/pipeline/frame_builder.h"
#include "techniques/shared/nodes.h"

namespace kaustik {

Hits interactAsNeeded(FrameBuilder& frame, const params::NoParams&, Hits hits) {
    const std::optional<scene::ReflectedLight>& seen = frame.needs().reflectedLight;
    const bool isFirst = frame.runsOf(SpecularStage::name) == 1;
    if (seen) {
        if (isFirst) {
            frame.leaveOut(
                "specular.interface",
                fmt::format("{:.0f}% of the light on '{}' is reflected, and '{}' lies in "
                            "its way: both branches are followed",
                            100.0 * seen->share, seen->sheet, seen->receiver));
        }
        return splitAtInterface(frame, frame.params<SplitParams>("specular.split"), hits);
    }
    if (isFirst) {
        frame.leaveOut("specular.split",
                       "no sheet reflects more than 4% of its light towards a receiver; "
                       "specular=split follows what is reflected all the same");
    }
    return interactAtInterface(frame, {}, hits);
}

}  // namespace kaustik
