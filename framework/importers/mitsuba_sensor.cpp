// SPDX-License-Identifier: MIT
// The sensor of a Mitsuba scene, and the media: the one that the eye is in fills the scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/importers/mitsuba_parts.h"

namespace kaustik::scene {
namespace {

constexpr double kDefaultWidth = 768.0;
constexpr double kDefaultHeight = 576.0;
// The diagonal of a frame of 35 mm film, 36 by 24 mm.
constexpr double kFilmDiagonal = 43.266615305567875;

void readFilm(MitsubaImport& importer, const MitsubaElement& sensor) {
    double width = kDefaultWidth;
    double height = kDefaultHeight;
    for (const MitsubaElement& film : sensor.children) {
        if (film.tag != "film") continue;
        film.isUsed = true;
        width = film.number("width", width);
        height = film.number("height", height);
        const bool isCropped =
            film.child("crop_width") != nullptr || film.child("crop_height") != nullptr;
        static_cast<void>(film.child("crop_offset_x"));
        static_cast<void>(film.child("crop_offset_y"));
        if (isCropped) importer.change(film, "it is not cropped");
    }
    if (!(width >= 1.0) || !(height >= 1.0) || width > 1e5 || height > 1e5)
        failAt(sensor.place, "a picture has from 1 to 100000 pixels a side.");
    importer.scene.width = static_cast<std::uint32_t>(width);
    importer.scene.height = static_cast<std::uint32_t>(height);
}

double verticalFovOf(const MitsubaImport& importer, const MitsubaElement& sensor) {
    const double aspect = double(importer.scene.width) / importer.scene.height;
    double degrees = 0.0;
    std::string axis = sensor.text("fov_axis", "x");
    if (sensor.child("fov") != nullptr) {
        degrees = sensor.number("fov", 0.0);
    } else {
        std::string length = sensor.text("focal_length", "50mm");
        if (length.ends_with("mm")) length.resize(length.size() - 2);
        const double millimeters = parseOneNumber(length, sensor.place);
        if (!(millimeters > 0.0)) failAt(sensor.place, "a focal length is above 0.");
        degrees = glm::degrees(2.0 * std::atan(0.5 * kFilmDiagonal / millimeters));
        axis = "diagonal";
    }
    if (!(degrees > 0.0 && degrees < 180.0))
        failAt(sensor.place, fmt::format("a field of view is between 0 and 180, not {}.", degrees));
    if (axis == "x") return verticalFov(degrees, aspect);
    if (axis == "y") return degrees;
    if (axis == "diagonal") return verticalFov(degrees, std::sqrt(1.0 + aspect * aspect));
    if (axis == "smaller") return aspect > 1.0 ? degrees : verticalFov(degrees, aspect);
    if (axis == "larger") return aspect > 1.0 ? verticalFov(degrees, aspect) : degrees;
    failAt(sensor.place,
           fmt::format("fov_axis is x, y, diagonal, smaller or larger, not '{}'.", axis));
}

void readMediumOfScene(MitsubaImport& importer, const MitsubaElement& sensor) {
    for (const MitsubaElement& child : sensor.children) {
        if (child.tag != "medium" && child.tag != "ref") continue;
        const MitsubaElement& element = importer.document.resolve(child);
        if (element.tag == "medium") importer.scene.medium = mediumOf(importer, element);
    }
}

double meanCosine(MitsubaImport& importer, const MitsubaElement& medium) {
    for (const MitsubaElement& child : medium.children) {
        if (child.tag != "phase") continue;
        child.isUsed = true;
        if (child.type() == "hg") return std::clamp(child.number("g", 0.8), -0.999, 0.999);
        if (child.type() != "isotropic") importer.leaveOut(child, "it scatters in all directions");
    }
    return 0.0;
}

}  // namespace

std::optional<Medium> mediumOf(MitsubaImport& importer, const MitsubaElement& element) {
    if (element.type() != "homogeneous") {
        importer.leaveOut(element, "only homogeneous media have a counterpart");
        return std::nullopt;
    }
    glm::dvec3 absorption(0.0);
    glm::dvec3 scattering(0.0);
    if (element.child("sigma_a") != nullptr || element.child("sigma_s") != nullptr) {
        absorption = evenColor(importer, element, "sigma_a", glm::dvec3(0.0));
        scattering = evenColor(importer, element, "sigma_s", glm::dvec3(0.0));
    } else {
        const glm::dvec3 extinction = evenColor(importer, element, "sigma_t", glm::dvec3(1.0));
        const glm::dvec3 albedo =
            glm::clamp(evenColor(importer, element, "albedo", glm::dvec3(0.75)), 0.0, 1.0);
        scattering = extinction * albedo;
        absorption = extinction - scattering;
    }
    const double scale = element.number("scale", 1.0);
    Medium medium;
    medium.scatteringPerMeter = glm::vec3(glm::max(scale * scattering, 0.0));
    medium.absorptionPerMeter = glm::vec3(glm::max(scale * absorption, 0.0));
    medium.anisotropy = static_cast<float>(meanCosine(importer, element));
    return medium;
}

void readMitsubaSensor(MitsubaImport& importer, const MitsubaElement& element) {
    if (importer.scene.camera) return importer.leaveOut(element, "only the first sensor is taken");
    const std::string& type = element.type();
    if (type != "perspective" && type != "thinlens") {
        return importer.leaveOut(element, "only perspective and thinlens have a counterpart");
    }
    if (type == "thinlens") importer.change(element, "it has a pinhole, so that all is sharp");
    readFilm(importer, element);
    readMediumOfScene(importer, element);
    const glm::dmat4 toWorld = element.transform("to_world");
    Camera camera;
    camera.verticalFovDegrees = verticalFovOf(importer, element);
    aimCamera(camera, glm::dvec3(toWorld[3]), glm::dvec3(toWorld[2]), glm::dvec3(toWorld[1]),
              element.place);
    camera.nearMeters = std::max(element.number("near_clip", camera.nearMeters), 1e-6);
    static_cast<void>(element.child("far_clip"));  // there is no far plane
    if (glm::determinant(glm::dmat3(toWorld)) < 0.0)
        importer.change(element, "its picture is mirrored, and here it is not");
    importer.scene.camera = camera;
}

}  // namespace kaustik::scene
