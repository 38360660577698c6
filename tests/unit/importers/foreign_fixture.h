// SPDX-License-Identifier: MIT
// Scenes of other renderers for tests, and where a camera of this project sees a point.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "framework/core/error.h"
#include "framework/importers/foreign_file.h"
#include "framework/scene/foreign/foreign_area_light.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::scene::test {

using kaustik::test::messageOf;

class ForeignImport : public testing::Test {
  protected:
    explicit ForeignImport(std::string file) : file_(std::move(file)) {}

    [[nodiscard]] ForeignScene read(const std::string& text) const {
        return readForeignFile(folder.file(file_, text));
    }
    // What it says of a file whose text makes no sense.
    [[nodiscard]] std::string errorOf(const std::string& text) const {
        return messageOf<ConfigError>([&] { static_cast<void>(read(text)); });
    }
    [[nodiscard]] std::string ioErrorOf(const std::string& text) const {
        return messageOf<IoError>([&] { static_cast<void>(read(text)); });
    }
    [[nodiscard]] static std::string notesOf(const ForeignScene& scene) {
        std::string all;
        for (const ForeignNote& note : scene.notes) {
            all += (note.kind == NoteKind::leftOut ? "left out: " : "changed: ") + note.subject +
                   " (" + note.place + "): " + note.reason + "\n";
        }
        return all;
    }

    kaustik::test::TemporaryFolder folder;

  private:
    std::string file_;
};

// (-1, -1) is the lower left corner of the picture, (1, 1) the upper right.
inline glm::dvec2 seenAt(const ForeignScene& scene, const glm::dvec3& point) {
    const Camera camera = scene.camera.value_or(Camera());
    const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 up = glm::cross(right, forward);
    const glm::dvec3 way = point - camera.position;
    const double tangent = std::tan(glm::radians(0.5 * camera.verticalFovDegrees));
    const double aspect = double(scene.width) / scene.height;
    const double depth = glm::dot(way, forward);
    return {glm::dot(way, right) / (depth * tangent * aspect),
            glm::dot(way, up) / (depth * tangent)};
}

inline glm::dvec3 inWorld(const ForeignShape& shape, const glm::dvec3& point) {
    return glm::dvec3(shape.toWorld * glm::dvec4(point, 1.0));
}

// Matrices of a few rotations are off by some ulp.
inline void expectNear(const glm::dvec3& value, const glm::dvec3& expected,
                       double tolerance = 1e-9) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(value[i], expected[i], tolerance) << "component " << i;
}
inline void expectNear(const glm::dvec2& value, const glm::dvec2& expected) {
    expectNear(glm::dvec3(value, 0.0), glm::dvec3(expected, 0.0));
}

inline AreaLight areaLight(const ForeignShape& shape) {
    reading::ReaderProcess reader;
    return areaLightOf(shape, reader);
}

}  // namespace kaustik::scene::test
