// SPDX-License-Identifier: MIT
// The `shape = …` keys of an object in a scene file.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "framework/core/error.h"
#include "framework/scene/files/scene_file_parts.h"
#include "framework/scene/shapes/height_field.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene {
namespace {

constexpr NumberRange kApex{0.0, 180.0, true, true};

// Reads the keys of one shape; the mesh is made by what it returns, once all keys are known good.
using ShapeReader = std::function<Mesh()> (*)(TableReader&, double timeSeconds);

unsigned segments(TableReader& reader, const char* key, unsigned minimum, unsigned fallback) {
    return reader.count(key, minimum, kMaximumCells, fallback);
}

std::function<Mesh()> readPlane(TableReader& reader, double) {
    PlaneShape shape;
    shape.size = reader.vector2("size", kPositive);
    shape.cells = reader.counts("cells", 1, kMaximumCells, glm::uvec2(1));
    return [shape] { return makePlane(shape); };
}

std::function<Mesh()> readBox(TableReader& reader, double) {
    static const std::vector<std::string> kFaces{"-x", "+x", "-y", "+y", "-z", "+z"};
    BoxShape shape;
    shape.size = reader.vector3("size", kPositive);
    shape.inward = reader.flag("inward", false);
    for (const std::string& name : reader.texts("open")) {
        const auto face = std::find(kFaces.begin(), kFaces.end(), name);
        if (face == kFaces.end()) {
            reader.fail("open", "open: " + TableReader::notOneOf(name, kFaces));
        }
        shape.open[static_cast<std::size_t>(face - kFaces.begin())] = true;
    }
    return [shape] { return makeBox(shape); };
}

std::function<Mesh()> readSphere(TableReader& reader, double) {
    SphereShape shape;
    shape.radius = reader.number("radius", kPositive);
    shape.segments = segments(reader, "segments", 4, 128);
    return [shape] { return makeSphere(shape); };
}

std::function<Mesh()> readCylinder(TableReader& reader, double) {
    CylinderShape shape;
    shape.radius = reader.number("radius", kPositive);
    shape.height = reader.number("height", kPositive);
    shape.open = reader.flag("open", false);
    shape.inward = reader.flag("inward", false);
    shape.segments = segments(reader, "segments", 3, 128);
    return [shape] { return makeCylinder(shape); };
}

std::function<Mesh()> readRing(TableReader& reader, double) {
    RingShape shape;
    shape.innerRadius = reader.number("inner_radius", kPositive);
    shape.outerRadius = reader.number("outer_radius", kPositive);
    shape.height = reader.number("height", kPositive);
    shape.segments = segments(reader, "segments", 3, 256);
    return [shape] { return makeRing(shape); };
}

std::function<Mesh()> readTorus(TableReader& reader, double) {
    TorusShape shape;
    shape.radius = reader.number("radius", kPositive);
    shape.tubeRadius = reader.number("tube_radius", kPositive);
    shape.segments = segments(reader, "segments", 3, 128);
    shape.tubeSegments = segments(reader, "tube_segments", 3, 64);
    return [shape] { return makeTorus(shape); };
}

std::function<Mesh()> readTree(TableReader& reader, double) {
    TreeShape shape;
    shape.height = reader.number("height", kPositive);
    shape.trunkRadius = reader.number("trunk_radius", kPositive);
    shape.levels = segments(reader, "levels", 1, shape.levels);
    shape.children = segments(reader, "children", 1, shape.children);
    shape.sides = segments(reader, "sides", 3, shape.sides);
    shape.spreadDegrees = reader.number("spread_degrees", kPositive, shape.spreadDegrees);
    shape.seed = segments(reader, "seed", 1, 1);
    return [shape] { return makeTree(shape); };
}

std::function<Mesh()> readLens(TableReader& reader, double) {
    LensShape shape;
    shape.topRadius = reader.number("top_radius", kAnyNumber);
    shape.bottomRadius = reader.number("bottom_radius", kAnyNumber);
    shape.diameter = reader.number("diameter", kPositive);
    shape.centerThickness = reader.number("center_thickness", kPositive, 0.0);
    shape.edgeThickness = reader.number("edge_thickness", kPositive, 0.0);
    shape.segments = segments(reader, "segments", 3, 128);
    return [shape] { return makeLens(shape); };
}

std::function<Mesh()> readPrism(TableReader& reader, double) {
    PrismShape shape;
    shape.apexDegrees = reader.number("apex_degrees", kApex);
    shape.height = reader.number("height", kPositive);
    shape.length = reader.number("length", kPositive);
    return [shape] { return makePrism(shape); };
}

std::function<Mesh()> readParaboloid(TableReader& reader, double) {
    ParaboloidShape shape;
    shape.focalLength = reader.number("focal_length", kPositive);
    shape.diameter = reader.number("diameter", kPositive);
    shape.segments = segments(reader, "segments", 3, 128);
    return [shape] { return makeParaboloid(shape); };
}

std::function<Mesh()> readWater(TableReader& reader, double timeSeconds) {
    HeightField field;
    field.sizeMeters = reader.vector2("size", kPositive);
    field.cells = reader.counts("cells", 1, kMaximumCells, glm::uvec2(128));
    field.waves = readWaves(reader);
    return [field, timeSeconds] { return makeHeightField(field, timeSeconds); };
}

Wave readWave(TableReader& reader) {
    Wave wave;
    wave.amplitudeMeters = reader.numberAsFloat("amplitude", kNotNegative);
    wave.wavelengthMeters = reader.numberAsFloat("wavelength", kPositive);
    wave.directionDegrees = reader.numberAsFloat("direction_degrees", kAnyNumber, 0.0);
    wave.phaseRadians = reader.numberAsFloat("phase", kAnyNumber, 0.0);
    if (reader.has("omega")) {
        wave.omegaRadiansPerSecond = reader.numberAsFloat("omega", kNotNegative);
    }
    reader.finish();
    return wave;
}

}  // namespace

std::vector<Wave> readWaves(TableReader& reader) {
    if (reader.has("wave") && reader.has("waves")) {
        reader.fail("wave", "the waves are listed in waves or as [[object.wave]], not both");
    }
    std::vector<Wave> waves;
    for (const char* key : {"waves", "wave"}) {
        for (TableReader& wave : reader.tables(key))
            waves.push_back(readWave(wave));
    }
    return waves;
}

Mesh readShape(TableReader& reader, double timeSeconds) {
    const auto readKeys = reader.choice<ShapeReader>("shape", {{"plane", readPlane},
                                                               {"box", readBox},
                                                               {"sphere", readSphere},
                                                               {"cylinder", readCylinder},
                                                               {"ring", readRing},
                                                               {"torus", readTorus},
                                                               {"tree", readTree},
                                                               {"lens", readLens},
                                                               {"prism", readPrism},
                                                               {"paraboloid", readParaboloid},
                                                               {"water", readWater}});
    const std::function<Mesh()> make = readKeys(reader, timeSeconds);
    reader.finish();
    try {
        return make();
    } catch (const ConfigError& error) {
        // What concerns several keys at once, such as a lens whose faces cross.
        reader.fail("shape", error.what());
    }
}

}  // namespace kaustik::scene
