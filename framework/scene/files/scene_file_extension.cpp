// SPDX-License-Identifier: MIT
// Scene files with `extends`: another scene with another camera, other waves, lights elsewhere.
#include "framework/core/error.h"
#include "framework/scene/files/scene_file_parts.h"

namespace kaustik::scene {
namespace {

LightEdit readLightEdit(TableReader& reader) {
    LightEdit edit;
    if (reader.has("direction")) {
        static_cast<void>(reader.direction("direction"));  // not zero
        edit.direction = reader.vector3("direction", kAnyNumber);
    }
    if (reader.has("position")) edit.position = reader.vector3("position", kAnyNumber);
    if (reader.has("power_factor"))
        edit.powerFactor = reader.numberAsFloat("power_factor", kNotNegative);
    reader.finish();
    return edit;
}

}  // namespace

SceneEdits readEdits(TableReader& top) {
    SceneEdits edits;
    if (top.has("time")) edits.timeSeconds = top.number("time", kAnyNumber);
    std::optional<TableReader> camera = top.table("camera");
    std::optional<TableReader> medium = top.table("medium");
    std::vector<TableReader> lights = top.tables("light");
    std::vector<TableReader> waters = top.tables("water");
    top.finish();

    if (camera) edits.camera = readCamera(*camera);
    if (medium) edits.medium = readMedium(*medium);
    for (TableReader& reader : lights) {
        const std::string name = reader.name();
        if (!edits.lights.emplace(name, readLightEdit(reader)).second)
            reader.fail("name", "this light is changed twice");
    }
    for (TableReader& reader : waters) {
        const std::string object = reader.text("object");
        std::vector<Wave> waves = readWaves(reader);
        reader.finish();
        if (!edits.waves.emplace(object, std::move(waves)).second)
            reader.fail("object", "this water is changed twice");
    }
    return edits;
}

}  // namespace kaustik::scene
