// SPDX-License-Identifier: MIT
// Scene files with `extends`: another scene with another camera, other waves, lights elsewhere.
#include "framework/core/error.h"
#include "framework/scene/files/scene_file_parts.h"

namespace kaustik::scene {

SceneEdits readEdits(TableReader& top) {
    return makeEdits(top.read<EditKeys>());
}

SceneEdits makeEdits(EditKeys keys) {
    SceneEdits edits;
    edits.timeSeconds = keys.timeSeconds;
    if (keys.camera.reader) edits.camera = readCamera(*keys.camera.reader);
    if (keys.medium.reader) edits.medium = keys.medium.reader->read<Medium>();
    for (TableReader& reader : keys.lights.readers) {
        const auto light = reader.read<LightEditKeys>();
        const LightEdit edit{light.direction, light.position, light.powerFactor,
                             light.angularDiameterDegrees};
        if (!edits.lights.emplace(light.name, edit).second)
            reader.fail("name", "this light is changed twice");
    }
    for (TableReader& reader : keys.waters.readers) {
        auto water = reader.read<WaterEditKeys>();
        if (!edits.waves.emplace(water.object, std::move(water.waves)).second)
            reader.fail("object", "this water is changed twice");
    }
    return edits;
}

}  // namespace kaustik::scene
