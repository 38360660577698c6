// SPDX-License-Identifier: MIT
// trace.plane: photons' rays hit analytically with the scene's flat receivers, one compute thread a
// photon (K06, section 1.1: what was done before rays were traced on the screen; Fig. 2: a plane
// and the faces of a box). Flat are planes and the faces of boxes, of either side
// (scene/flat_faces.h). In: photons, eye view space, m; out: hits, W that arrive after absorption.
// It finds what lies off the screen. It sees nothing else: no curved receivers, which light passes,
// and of specular surfaces what the lights see (tracing/specular_ahead.h), where light is stopped.
#include <fmt/format.h>

#include <string>

#include "framework/core/names.h"
#include "framework/pipeline/frame_builder.h"
#include "framework/scene/flat_faces.h"
#include "techniques/trace/plane_face.h"
#include "techniques/tracing/specular_ahead.h"

namespace kaustik {
namespace {

struct Planes {
    gl::Buffer faces;
    int count = 0;
    // Of a photon that hits none of them: whether it may have hit something else.
    unsigned missAccount = transport::kAccountLeftScene;
};

glm::vec4 withW(const glm::dvec3& xyz, double w) {
    return glm::vec4(glm::dvec4(xyz, w));
}

planar::FlatFace faceInView(const scene::FlatReceivers::Face& face, const glm::dmat4& worldToView) {
    const glm::dmat3 rotation(worldToView);
    const glm::dvec3 u = rotation * face.shape.edgeU;
    const glm::dvec3 v = rotation * face.shape.edgeV;
    const glm::dvec3 area = glm::cross(u, v);
    const double area2 = glm::dot(area, area);
    const glm::dvec3 acrossU = glm::cross(v, area) / area2;
    const glm::dvec3 acrossV = glm::cross(area, u) / area2;
    return {withW(glm::dvec3(worldToView * glm::dvec4(face.shape.corner, 1.0)), 0.0),
            withW(rotation * face.shape.normal, face.material + 1.0),
            withW(acrossU, glm::length(acrossU)), withW(acrossV, glm::length(acrossV))};
}

std::string quoted(const std::vector<std::string>& names) {
    std::vector<std::string> all;
    for (const std::string& name : names)
        all.push_back("'" + name + "'");
    return joinNames(all);
}

std::shared_ptr<Planes> makePlanes(FrameBuilder& frame) {
    const scene::FlatReceivers flat = scene::flatReceivers(frame.scene());
    std::vector<planar::FlatFace> faces;
    for (const scene::FlatReceivers::Face& face : flat.faces)
        faces.push_back(faceInView(face, frame.view().worldToView));
    auto planes = std::make_shared<Planes>();
    planes->count = static_cast<int>(faces.size());
    faces.push_back({});  // a block is never empty
    planes->faces = gl::Buffer(faces, "flat receivers");
    // What would hit a specular surface again is stopped where the lights see that, if they do.
    const scene::RepeatedHits& again = frame.needs().repeatedHits;
    const bool mayMeetMore = again.outside && (again.transmitted || again.reflected);
    if (mayMeetMore || !flat.others.empty()) planes->missAccount = transport::kAccountUnresolved;
    if (!flat.others.empty()) {
        frame.warn(fmt::format("trace=plane sees flat receivers alone: light passes {}.",
                               quoted(flat.others)));
    }
    return planes;
}

Hits tracePlane(FrameBuilder& frame, const params::NoParams&, Photons photons, Surfaces surfaces) {
    const SpecularAhead ahead = findSpecularAhead(frame, photons, surfaces.geometry);
    const auto planes = frame.once<Planes>("trace.planes", [&] { return makePlanes(frame); });
    return frame.pass<Hits>(
        "trace.plane",
        fmt::format("one thread a photon hits {} flat face{} of receivers", planes->count,
                    planes->count == 1 ? "" : "s"),
        [&](graph::PassSetup& setup, Hits& hits) {
            photons.sample(setup);
            ahead.sample(setup);
            hits = Hits::create(setup, photons);
            hits.incoming.account(setup);
            hits.store(setup);
        },
        [planes](const Hits& hits, gl::PassContext& context) {
            dispatchOver(context.compute("trace/plane.comp")
                             .storage("FlatFaces", planes->faces)
                             .set("faceCount", planes->count)
                             .set("missAccount", planes->missAccount),
                         hits.incoming);
        });
}

}  // namespace

void registerTracePlane(Registry& registry) {
    registry.node<TraceStage>(
        "plane",
        {"Hits each photon's ray with the planes of flat receivers; no other "
         "surface is seen.",
         "K06, section 1.1, Fig. 2",
         "It finds planes and the faces of boxes and nothing else: light passes curved receivers, "
         "which a warning names. It refuses photons inside of bodies, and of specular surfaces "
         "knows what trace.blockers shows it."},
        {.reach = TracerReach::flatReceivers, .onlyReceivers = true}, &tracePlane);
}

}  // namespace kaustik
