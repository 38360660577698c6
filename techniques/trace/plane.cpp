// SPDX-License-Identifier: MIT
// trace.plane: photons' rays hit analytically with the scene's flat receivers, one compute thread a
// photon (K06, section 1.1: what was done before rays were traced on the screen; Fig. 2: a plane
// and the faces of a box). Flat are planes and the faces of boxes, of either side
// (scene/flat_faces.h). In: photons, eye view space, m; out: hits, W that arrive after absorption.
// It finds what lies off the screen. It sees nothing else: neither curved receivers, which light
// passes, nor specular surfaces; a photon inside of glass needs its far side, and is counted as
// missed by the tracer.
#include <fmt/format.h>

#include <string>

#include "framework/core/names.h"
#include "framework/pipeline/frame_builder.h"
#include "framework/scene/flat_faces.h"
#include "framework/scene/light_paths.h"
#include "techniques/trace/plane_face.h"

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

// What of the scene the tracer does not see, in a sentence; "" where that is nothing that a photon
// can hit.
std::string unseenSurfacesMessage(const FrameBuilder& frame,
                                  const std::vector<std::string>& curved) {
    const scene::Scene& scene = frame.scene();
    const scene::RepeatedHits& again = frame.needs().repeatedHits;
    std::vector<std::string> bodies;
    std::vector<std::string> sheets;
    for (const scene::Object& object : scene.objects) {
        const scene::Material& material = scene.materials[object.material];
        const scene::Mesh& mesh = scene.meshes[object.mesh];
        if (isReceiver(material.kind) || mesh.triangles.empty()) continue;
        const bool isBody =
            material.kind == scene::MaterialKind::dielectric && !isOpen(scene, object.material);
        if (isBody) {
            bodies.push_back(object.name);
        } else if (again.transmitted || again.reflected) {
            sheets.push_back(object.name);
        }
    }
    std::vector<std::string> parts;
    if (!curved.empty()) parts.push_back(fmt::format("light passes {}", quoted(curved)));
    if (!sheets.empty()) {
        parts.push_back(fmt::format("what would hit {} a second time does not", quoted(sheets)));
    }
    if (!bodies.empty()) {
        parts.push_back(
            fmt::format("what has entered {} is lost ('tracer' in the ledger)", quoted(bodies)));
    }
    if (parts.empty()) return "";
    std::string sentence = "trace=plane sees flat receivers alone: ";
    for (std::size_t i = 0; i < parts.size(); ++i)
        sentence += (i == 0 ? "" : "; ") + parts[i];
    return sentence + ".";
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
    const std::string notSeen = unseenSurfacesMessage(frame, flat.others);
    if (!notSeen.empty()) {
        frame.warn(notSeen);
        planes->missAccount = transport::kAccountUnresolved;
    }
    return planes;
}

Hits tracePlane(FrameBuilder& frame, const params::NoParams&, Photons photons,
                Surfaces /*surfaces*/) {
    const auto planes = frame.once<Planes>("trace.planes", [&] { return makePlanes(frame); });
    return frame.pass<Hits>(
        "trace.plane",
        fmt::format("one thread a photon hits {} flat face{} of receivers", planes->count,
                    planes->count == 1 ? "" : "s"),
        [&](graph::PassSetup& setup, Hits& hits) {
            photons.sample(setup);
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
         "what would hit a specular surface a second time does not, and what has entered a body is "
         "lost as tracer. A warning names them."},
        {TracerReach::flatReceivers}, &tracePlane);
}

}  // namespace kaustik
