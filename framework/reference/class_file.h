// SPDX-License-Identifier: MIT
// The classes of a reference as images and as one OpenEXR file of named layers: R, G and B are all
// of the caustic irradiance and error.R … its standard error; NAME.R … and NAME.error.R … those of
// each class, in W/m². Next to the pixels the header says what they are of:
//
//   kaustik.key       Reference::key, of everything that they depend on
//   kaustik.scene     the scene's name
//   kaustik.photons   how many were traced
//   kaustik.classes   the classes' names, a blank between them; `other` is the last
//   kaustik.class.NAME  its pattern (path_pattern.h)
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/reference/path_classes.h"
#include "framework/reference/pixel_sums.h"
#include "framework/reference/reference.h"

namespace kaustik::reference {

// What a file of classes holds.
struct ClassLayers {
    std::string key;
    std::string scene;
    std::uint64_t photons = 0;
    Image irradiance;  // of all paths, W/m²
    Image irradianceError;
    std::vector<ClassImages> classes;  // `other` is the last
};

// The images of classes and of `other`, which the sums hold from `firstLayer` on. In each pixel
// they add up to the image of all within 1 ulp of it: what the rounding of a smaller class has left
// goes to the next larger one.
[[nodiscard]] std::vector<ClassImages> classImages(const std::vector<PathClass>& classes,
                                                   const PixelSums& sums, int firstLayer);

// NAME.classes.exr for a reference NAME.exr.
[[nodiscard]] std::filesystem::path classFile(const std::filesystem::path& reference);

// Throws IoError, naming the file, where it cannot be written or there is no module for images.
void writeClasses(const std::filesystem::path& file, const Reference& reference);

// Throws IoError, naming the file, where it cannot be read, has no classes, or holds what is no
// number. Whether it is of a scene its key says.
[[nodiscard]] ClassLayers readClasses(const std::filesystem::path& file);

// Of the names and the pixels.
[[nodiscard]] std::string fingerprintOf(const std::vector<ClassImages>& classes);

}  // namespace kaustik::reference
