// SPDX-License-Identifier: MIT
#include "framework/importers/answer_request.h"

#include "framework/image/image_wire.h"
#include "framework/image/layered_wire.h"
#include "framework/image/module_images.h"
#include "framework/importers/foreign_file.h"
#include "framework/importers/gltf_file.h"
#include "framework/importers/mesh_file.h"
#include "framework/importers/toml_file.h"
#include "framework/reading/service.h"
#include "framework/scene/files/scene_wire.h"

namespace kaustik::scene {
namespace {

using reading::Request;
using reading::RequestKind;

Image readAnyImage(const Request& request) {
    return request.file.empty() ? decodeByModule(request.bytes, request.name)
                                : readByModule(request.file, request.name);
}

}  // namespace

void answerRequest(const Request& request, reading::Channel& channel) {
    switch (request.kind) {
        case RequestKind::toml:
            return reading::answer(channel, [&] { return parseTomlFile(request.file); });
        case RequestKind::mesh:
            return reading::answer(channel, [&] { return readMeshFile(request.file); });
        case RequestKind::gltf:
            return reading::answer(channel, [&] { return readGltfFile(request.file); });
        case RequestKind::foreign:
            return reading::answer(channel, [&] { return readForeignFile(request.file); });
        case RequestKind::image:
            return reading::answer(channel, [&] { return readAnyImage(request); });
        case RequestKind::layers:
            return reading::answer(channel,
                                   [&] { return readLayersByModule(request.file, request.name); });
    }
}

}  // namespace kaustik::scene
