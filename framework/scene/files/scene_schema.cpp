// SPDX-License-Identifier: MIT
#include "framework/scene/files/scene_schema.h"

#include "framework/core/json_schema.h"
#include "framework/scene/files/scene_keys.h"
#include "framework/scene/files/table_schema.h"

namespace kaustik::scene {

nlohmann::json sceneSchema() {
    return schemaDocument(
        "scene", "A scene of Kaustik",
        eitherSchema("extends", tableSchema<ExtensionKeys>(), tableSchema<SceneKeys>()));
}

}  // namespace kaustik::scene
