// SPDX-License-Identifier: MIT
// The meshes of `shape = …` objects of a scene file.
#include "framework/core/error.h"
#include "framework/scene/files/scene_file_parts.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::scene {
namespace {

struct MakeMesh {
    double timeSeconds;

    Mesh operator()(const PlaneShape& shape) const { return makePlane(shape); }
    Mesh operator()(const DiscShape& shape) const { return makeDisc(shape); }
    Mesh operator()(const BoxShape& shape) const { return makeBox(shape); }
    Mesh operator()(const SphereShape& shape) const { return makeSphere(shape); }
    Mesh operator()(const CylinderShape& shape) const { return makeCylinder(shape); }
    Mesh operator()(const RingShape& shape) const { return makeRing(shape); }
    Mesh operator()(const TorusShape& shape) const { return makeTorus(shape); }
    Mesh operator()(const TreeShape& shape) const { return makeTree(shape); }
    Mesh operator()(const LensShape& shape) const { return makeLens(shape); }
    Mesh operator()(const PrismShape& shape) const { return makePrism(shape); }
    Mesh operator()(const ParaboloidShape& shape) const { return makeParaboloid(shape); }
    Mesh operator()(const HeightField& water) const { return makeHeightField(water, timeSeconds); }
};

}  // namespace

Mesh makeShape(const Shape& shape, const TableReader& reader, double timeSeconds) {
    try {
        return std::visit(MakeMesh{timeSeconds}, shape);
    } catch (const ConfigError& error) {
        // What concerns several keys at once, such as a lens whose faces cross.
        reader.fail("shape", error.what());
    }
}

}  // namespace kaustik::scene
