// SPDX-License-Identifier: MIT
// kaustik_reader: the process in which the libraries read what came from somewhere else
// (framework/reading/reader_process.h).
#include <cstdlib>

#include "framework/image/image_wire.h"
#include "framework/image/openimageio_images.h"
#include "framework/importers/gltf_file.h"
#include "framework/importers/mesh_file.h"
#include "framework/importers/toml_file.h"
#include "framework/reading/service.h"
#include "framework/scene/files/scene_wire.h"

#ifdef __SANITIZE_ADDRESS__
// As in the program: what libraries keep is theirs.
extern "C" const char* __asan_default_options() {
    return "detect_leaks=0";
}
#endif

namespace {

using namespace kaustik;
using reading::Request;
using reading::RequestKind;

Image readAnyImage(const Request& request) {
    return request.file.empty() ? decodeByOpenImageIo(request.bytes, request.name)
                                : readByOpenImageIo(request.file, request.name);
}

void handle(const Request& request, reading::Channel& channel) {
    switch (request.kind) {
        case RequestKind::toml:
            return answer(channel, [&] { return scene::parseTomlFile(request.file); });
        case RequestKind::mesh:
            return answer(channel, [&] { return scene::readMeshFile(request.file); });
        case RequestKind::gltf:
            return answer(channel, [&] { return scene::readGltfFile(request.file); });
        case RequestKind::image:
            return answer(channel, [&] { return readAnyImage(request); });
    }
}

}  // namespace

int main(int argc, char** argv) {
    // A pool of threads, one a core, would take address space for nothing.
    ::setenv("OPENIMAGEIO_THREADS", "1", 0);
    return reading::serve(argc, argv, handle);
}
