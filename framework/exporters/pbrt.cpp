// SPDX-License-Identifier: MIT
// A scene for pbrt-v4 (its "File format" page). World space is right-handed here and left-handed
// there, so that the picture would be mirrored: Scale -1 1 1 before LookAt turns it back. `fov` is
// that of the picture's shorter side. A distant light's L is what a surface that faces it receives,
// W/m²; the film's sensor is cie1931, whose values are radiance for an exposure of 1 s at ISO 100.
#include <fmt/format.h>

#include <cmath>

#include "framework/exporters/parts.h"
#include "framework/scene/spectrum.h"

namespace kaustik::exporters {
namespace {

std::string rgb(const char* name, const glm::dvec3& color) {
    return fmt::format("\"rgb {}\" [ {} ]", name, text(color, " "));
}

std::string point(const char* name, const glm::dvec3& position) {
    return fmt::format("\"point3 {}\" [ {} ]", name, text(position, " "));
}

class PbrtScene {
  public:
    explicit PbrtScene(Exporter& exporter) : exporter_(exporter), scene_(exporter.scene) {}

    void run() {
        writeHead();
        for (const scene::Light& light : exporter_.lights())
            writeLight(light);
        for (std::uint32_t i = 0; i < scene_.materials.size(); ++i) {
            if (exporter_.isUsed(i)) writeMaterial(i);
        }
        for (const WorldMesh& mesh : exporter_.meshes())
            writeShape(mesh);
        exporter_.writeScene("scene.pbrt", pbrt_, "pbrt scene.pbrt");
    }

  private:
    void line(const std::string& text) { pbrt_ += text + "\n"; }

    void writeHead() {
        const Axes eye = exporter_.camera();
        const ExportRequest& request = exporter_.request;
        line(fmt::format("# {}: metres; colours are linear Rec.709; radiance is W/m^2/sr",
                         scene_.name));
        line("Scale -1 1 1");
        line(fmt::format("LookAt {}  {}  {}", text(eye.position, " "),
                         text(eye.position + eye.forward, " "), text(eye.up, " ")));
        const double tangent = std::min(eye.tangentX, eye.tangentY);
        if (scene_.medium) {
            writeMedium("medium_of_scene", glm::dvec3(scene_.medium->absorptionPerMeter),
                        glm::dvec3(scene_.medium->scatteringPerMeter),
                        static_cast<double>(scene_.medium->anisotropy));
            line("MediumInterface \"\" \"medium_of_scene\"");
        }
        line(fmt::format("Camera \"perspective\" \"float fov\" [ {} ]",
                         text(glm::degrees(2.0 * std::atan(tangent)))));
        line(
            fmt::format("Film \"rgb\" \"integer xresolution\" [ {} ] \"integer yresolution\" [ {} "
                        "] \"string filename\" [ \"theirs.exr\" ] \"string sensor\" [ \"cie1931\" "
                        "]",
                        request.width, request.height));
        line("PixelFilter \"box\"");
        line("Sampler \"halton\" \"integer pixelsamples\" [ 64 ]");
        line(
            fmt::format("Integrator \"sppm\" \"integer maxdepth\" [ 32 ] \"integer "
                        "photonsperiteration\" [ {} ]",
                        request.photons));
        line("ColorSpace \"srgb\"");
        line("WorldBegin");
    }

    void writeMedium(const std::string& name, const glm::dvec3& absorption,
                     const glm::dvec3& scattering, double anisotropy) {
        line(fmt::format(
            "MakeNamedMedium \"{}\" \"string type\" [ \"homogeneous\" ] {} {} "
            "\"float g\" [ {} ]",
            name, rgb("sigma_a", absorption), rgb("sigma_s", scattering), text(anisotropy)));
    }

    void writeLight(const scene::Light& light) {
        const std::string subject = fmt::format("light '{}'", light.name);
        const glm::dvec3 power(light.power);
        ++exporter_.result.lightCount;
        if (light.rangeMeters > 0.0f) exporter_.change(subject, "it shines on beyond its range");
        if (light.kind == scene::LightKind::directional) {
            if (light.angularDiameterRadians > 0.0f) {
                exporter_.change(subject,
                                 fmt::format("its disc of {:.3g} degrees is a point of the sky",
                                             glm::degrees(light.angularDiameterRadians)));
            }
            line(fmt::format("LightSource \"distant\" {} {} {}", rgb("L", power),
                             point("from", -light.direction), point("to", glm::dvec3(0.0))));
            return;
        }
        if (light.kind == scene::LightKind::point) {
            line(fmt::format("LightSource \"point\" {} {}", rgb("I", power),
                             point("from", light.position)));
            return;
        }
        exporter_.change(subject, "between its cones it fades by pbrt's smooth step");
        if (light.image >= 0) exporter_.leaveOut(subject, "the picture that it projects");
        const double outer = glm::degrees(static_cast<double>(light.outerConeRadians));
        const double inner = glm::degrees(static_cast<double>(light.innerConeRadians));
        line(fmt::format(
            "LightSource \"spot\" {} {} {} \"float coneangle\" [ {} ] \"float "
            "conedeltaangle\" [ {} ]",
            rgb("I", power), point("from", light.position),
            point("to", light.position + light.direction), text(outer), text(outer - inner)));
    }

    void writeReceiver(std::uint32_t index, const std::string& id) {
        const scene::Material& material = scene_.materials[index];
        const Picture picture = exporter_.albedoPicture(index, PictureFormat::exr, true);
        if (picture.kind == PictureKind::none) {
            line(fmt::format("MakeNamedMaterial \"{}\" \"string type\" [ \"diffuse\" ] {}", id,
                             rgb("reflectance", glm::dvec3(material.albedo))));
            return;
        }
        const std::string texture = "picture_" + id;
        const std::string scale = text(1.0 / picture.repeatUnits);
        if (picture.kind == PictureKind::checker) {
            // Its squares have sides of 1.
            line(
                fmt::format("Texture \"{}\" \"spectrum\" \"checkerboard\" \"float uscale\" [ 1 ] "
                            "\"float vscale\" [ 1 ] {} {}",
                            texture, rgb("tex1", glm::dvec3(material.albedo)),
                            rgb("tex2", glm::dvec3(material.patternAlbedo))));
        } else {
            line(
                fmt::format("Texture \"{0}\" \"spectrum\" \"imagemap\" \"string filename\" [ "
                            "\"{1}\" ] \"string filter\" [ \"{2}\" ] \"string wrap\" [ \"repeat\" "
                            "] \"float uscale\" [ {3} ] \"float vscale\" [ {3} ]",
                            texture, picture.file, picture.isSmooth ? "bilinear" : "point", scale));
        }
        line(
            fmt::format("MakeNamedMaterial \"{}\" \"string type\" [ \"diffuse\" ] \"texture "
                        "reflectance\" [ \"{}\" ]",
                        id, texture));
    }

    // At steps through the visible spectrum where it is not the same for all light.
    static std::string etaOf(const scene::Material& material) {
        if (material.dispersion == glm::vec4(0.0f))
            return fmt::format("\"float eta\" [ {} ]", text(static_cast<double>(material.ior)));
        std::string eta = "\"spectrum eta\" [";
        constexpr double kStep = 10.0;
        for (double nanometers = scene::kShortestNanometers;
             nanometers <= scene::kLongestNanometers; nanometers += kStep) {
            eta += fmt::format(" {} {}", text(nanometers),
                               text(scene::indexAt(material, scene::dispersionPlace(nanometers))));
        }
        return eta + " ]";
    }

    void writeMaterial(std::uint32_t index) {
        const scene::Material& material = scene_.materials[index];
        const std::string id = exporter_.materialIdentifier(index);
        if (scene::isReceiver(material.kind)) return writeReceiver(index, id);
        std::string surface;
        if (material.kind == scene::MaterialKind::mirror) {
            surface = fmt::format("\"string type\" [ \"conductor\" ] {} \"float roughness\" [ 0 ]",
                                  rgb("reflectance", glm::dvec3(material.albedo)));
            if (material.albedo != glm::vec3(1.0f)) {
                exporter_.change(fmt::format("material '{}'", material.name),
                                 "it reflects more at grazing angles, as pbrt's metals do");
            }
        } else {
            surface = fmt::format("\"string type\" [ \"dielectric\" ] {} \"float roughness\" [ 0 ]",
                                  etaOf(material));
            if (material.absorptionPerMeter != glm::vec3(0.0f)) {
                writeMedium("inside_" + id, glm::dvec3(material.absorptionPerMeter),
                            glm::dvec3(0.0), 0.0);
            }
        }
        if (material.normalMap >= 0) {
            surface += fmt::format(" \"string normalmap\" [ \"{}\" ]",
                                   exporter_.normalMapFile(index, PictureFormat::exr));
        }
        line(fmt::format("MakeNamedMaterial \"{}\" {}", id, surface));
    }

    void writeShape(const WorldMesh& mesh) {
        const scene::Material& material = scene_.materials[mesh.material];
        const MeshFile written = exporter_.writeMesh(mesh, false);
        line("AttributeBegin");
        line(fmt::format("  NamedMaterial \"{}\"", written.material));
        if (written.isEmitter) {
            line(fmt::format("  AreaLightSource \"diffuse\" {}",
                             rgb("L", glm::dvec3(material.emission))));
        }
        if (material.kind == scene::MaterialKind::dielectric &&
            (scene_.medium || written.hasAbsorbingInterior)) {
            line(fmt::format("  MediumInterface \"{}\" \"{}\"",
                             written.hasAbsorbingInterior ? "inside_" + written.material : "",
                             scene_.medium ? "medium_of_scene" : ""));
        }
        line(fmt::format("  Shape \"plymesh\" \"string filename\" [ \"{}\" ]", written.file));
        line("AttributeEnd");
    }

    Exporter& exporter_;
    const scene::Scene& scene_;
    std::string pbrt_;
};

}  // namespace

void exportPbrt(Exporter& exporter) {
    PbrtScene(exporter).run();
}

}  // namespace kaustik::exporters
