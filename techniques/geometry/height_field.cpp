// SPDX-License-Identifier: MIT
// geometry.height_field: makes the vertices of wavy water on the GPU, each frame. Model space, m;
// the same sum of waves as scene/shapes/height_field.h evaluates on the CPU.
#include <cmath>

#include "framework/pipeline/frame_builder.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik {
namespace {

struct FieldData {
    int firstVertex, firstWave, waveCount;
    glm::ivec2 cells;
    glm::vec2 sizeMeters;
};

// The phases at the scene's time are reduced in double: a float of 1e6 rad has no digits left.
std::vector<FieldData> collectFields(const FrameBuilder& frame, std::vector<glm::vec4>& waves) {
    std::vector<FieldData> fields;
    for (const render::GpuScene::HeightFieldRange& range : frame.gpuScene().heightFields()) {
        const scene::HeightField& field = *frame.scene().meshes[range.mesh].heightField;
        fields.push_back({static_cast<int>(range.firstVertex), static_cast<int>(waves.size()),
                          static_cast<int>(field.waves.size()), glm::ivec2(field.cells),
                          field.sizeMeters});
        for (const scene::Wave& wave : field.waves) {
            const double turn = 2.0 * 3.14159265358979323846;
            const double phase = std::remainder(
                wave.phaseRadians - scene::angularFrequency(wave) * frame.scene().timeSeconds,
                turn);
            waves.emplace_back(glm::vec2(scene::waveVector(wave)), wave.amplitudeMeters, phase);
        }
    }
    return fields;
}

Geometry makeHeightFields(FrameBuilder& frame, const params::NoParams&) {
    if (frame.gpuScene().heightFields().empty()) {
        frame.skip("geometry.height_field", "the scene has no height field");
        return {};
    }
    std::vector<glm::vec4> waves;
    const std::vector<FieldData> fields = collectFields(frame, waves);
    waves.emplace_back(0.0f);  // still water has none, and a block is never empty
    const gl::Buffer& waveBuffer = frame.keep(gl::Buffer(waves, "waves"));
    return frame.pass<Geometry>(
        "geometry.height_field", "the scene has a height field",
        [&](graph::PassSetup& setup, Geometry& data) {
            data.heightFields = setup.createBuffer<transport::VertexData>(
                "geometry.height_fields", frame.gpuScene().heightFieldVertexCount());
        },
        [fields, &waveBuffer](const Geometry& data, gl::PassContext& context) {
            for (const FieldData& field : fields) {
                context.compute("geometry/height_field.comp")
                    .storage("Vertices", data.heightFields)
                    .storage("Waves", waveBuffer)
                    .set("cells", field.cells)
                    .set("sizeMeters", field.sizeMeters)
                    .set("firstVertex", field.firstVertex)
                    .set("firstWave", field.firstWave)
                    .set("waveCount", field.waveCount)
                    .dispatchOver((field.cells.x + 1) * (field.cells.y + 1), 64);
            }
        });
}

}  // namespace

void registerGeometryHeightField(Registry& registry) {
    registry.node<GeometryStage>(
        "height_field",
        {"Makes the vertices of wavy water on the GPU.", "",
         "Water is a height over a rectangle, a sum of waves that are given: it does not break, "
         "and nothing that floats or falls in disturbs it. Its waves are known at the vertices of "
         "the mesh, and taken as flat between them."},
        &makeHeightFields);
}

}  // namespace kaustik
