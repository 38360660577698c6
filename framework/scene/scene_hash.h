// SPDX-License-Identifier: MIT
// A scene as part of a fingerprint: camera, lights, surfaces, images and medium as they are at the
// scene's time, whatever the files are called that they come from.
#pragma once

#include "framework/core/content_hash.h"
#include "framework/scene/scene.h"

namespace kaustik::scene {

// Reads the images' files; throws IoError where one cannot be read.
void addTo(ContentHash& hash, const Scene& scene);

}  // namespace kaustik::scene
