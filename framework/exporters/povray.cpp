// SPDX-License-Identifier: MIT
// A scene for POV-Ray 3.7 and its photons.
//
// POV-Ray has no radiometric units: a surface that faces a light of colour c has the colour albedo
// c, where its radiance is albedo E / π. So a light's colour is its irradiance over π, and what
// POV-Ray writes is radiance. Its camera has no handedness of its own: direction, right and up are
// given as vectors, and what it calls left-handed is only where a plain camera has its x. With
// `parallel` a light is directional; a point light falls with the square of the distance by
// fade_power 2, which is 2 / (1 + (d / fade_distance)²).
// Objects that photons are shot at block direct light, and dielectrics have no_image: POV-Ray's eye
// then looks straight through them, as the reference's does. Photons would not meet what has
// no_image either, so they are shot in a run of their own, shoot.ini, which keeps them in a file
// for the picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/exporters/parts.h"
#include "framework/scene/spectrum.h"

namespace kaustik::exporters {
namespace {

// The distance below which a point light's intensity no longer rises, as a share of what it is
// apart from the scene's bounds: the square of it is the error.
constexpr double kFadeShare = 1e-4;
constexpr int kTraceLevel = 32;

std::string vectorOf(const glm::dvec3& vector) {
    return fmt::format("<{}>", text(vector, ", "));
}

std::string colorOf(const glm::dvec3& color) {
    return "rgb " + vectorOf(color);
}

class PovrayScene {
  public:
    explicit PovrayScene(Exporter& exporter)
        : exporter_(exporter), scene_(exporter.scene), bounds_(scene::sceneBounds(scene_)) {}

    void run() {
        writeHead();
        writeCamera();
        for (const scene::Light& light : exporter_.lights())
            writeLight(light);
        for (std::uint32_t i = 0; i < scene_.materials.size(); ++i) {
            if (exporter_.isUsed(i)) writeMaterial(i);
        }
        for (const WorldMesh& mesh : exporter_.meshes())
            writeObject(mesh);
        if (scene_.medium) exporter_.leaveOut("medium", "light in it is not scattered there");
        const ExportRequest& request = exporter_.request;
        // Nine rays through each pixel, evenly: the box filter.
        exporter_.write("shoot.ini",
                        "Input_File_Name=scene.pov\nDeclare=Shoot=1\nOutput_to_File=off\n"
                        "Width=4\nHeight=3\nDisplay=off\n");
        exporter_.write("scene.ini",
                        fmt::format("Input_File_Name=scene.pov\nOutput_File_Name=theirs.exr\n"
                                    "Output_File_Type=E\nWidth={}\nHeight={}\nDisplay=off\n"
                                    "Antialias=on\nSampling_Method=1\nAntialias_Threshold=0.0\n"
                                    "Antialias_Depth=3\nJitter=off\n",
                                    request.width, request.height));
        exporter_.writeScene("scene.pov", pov_, "povray shoot.ini && povray scene.ini");
    }

  private:
    [[nodiscard]] double radius() const {
        return 0.5 * glm::length(bounds_.maximum - bounds_.minimum);
    }
    [[nodiscard]] glm::dvec3 middle() const { return 0.5 * (bounds_.minimum + bounds_.maximum); }

    void writeHead() {
        pov_ += fmt::format(
            "// {}, for POV-Ray 3.7: metres; colours are linear Rec.709; the picture's values are "
            "W/m²/sr.\n#version 3.7;\n"
            "global_settings {{\n  assumed_gamma 1.0\n  max_trace_level {}\n  adc_bailout 1e-6\n"
            "  ambient_light rgb 0\n  photons {{\n    count {}\n    autostop 0\n    jitter 1\n"
            "    gather 40, 160\n    max_trace_level {}\n    adc_bailout 1e-6\n"
            "    #ifdef (Shoot) save_file \"photons.ph\" #else load_file \"photons.ph\" #end\n"
            "  }}\n}}\n"
            "background {{ rgb 0 }}\n",
            scene_.name, kTraceLevel, exporter_.request.photons, kTraceLevel);
    }

    void writeCamera() {
        const Axes eye = exporter_.camera();
        pov_ += fmt::format(
            "camera {{\n  perspective\n  location {}\n  direction {}\n  right {}\n  up {}\n}}\n",
            vectorOf(eye.position), vectorOf(eye.forward), vectorOf(2.0 * eye.tangentX * eye.right),
            vectorOf(2.0 * eye.tangentY * eye.up));
    }

    void writeLight(const scene::Light& light) {
        const std::string subject = fmt::format("light '{}'", light.name);
        const glm::dvec3 power = glm::dvec3(light.power) / glm::pi<double>();
        ++exporter_.result.lightCount;
        if (light.rangeMeters > 0.0f) exporter_.change(subject, "it shines on beyond its range");
        if (light.kind == scene::LightKind::directional) {
            if (light.angularDiameterRadians > 0.0f) {
                exporter_.change(subject,
                                 fmt::format("its disc of {:.3g} degrees is a point of the sky",
                                             glm::degrees(light.angularDiameterRadians)));
            }
            pov_ += fmt::format(
                "light_source {{\n  {}\n  color {}\n  parallel\n  point_at {}\n"
                "  photons {{ reflection on refraction on }}\n}}\n",
                vectorOf(middle() - 4.0 * radius() * light.direction), colorOf(power),
                vectorOf(middle()));
            return;
        }
        const double fade = kFadeShare * radius();
        pov_ += fmt::format("light_source {{\n  {}\n  color {}\n", vectorOf(light.position),
                            colorOf(power / (2.0 * fade * fade)));
        if (light.kind == scene::LightKind::spot) {
            pov_ += fmt::format(
                "  spotlight\n  radius {}\n  falloff {}\n  tightness 0\n"
                "  point_at {}\n",
                text(glm::degrees(double(light.innerConeRadians))),
                text(glm::degrees(double(light.outerConeRadians))),
                vectorOf(light.position + light.direction));
            exporter_.change(subject, "between its cones it fades by POV-Ray's own curve");
            if (light.image >= 0) exporter_.leaveOut(subject, "the picture that it projects");
        }
        pov_ += fmt::format(
            "  fade_distance {}\n  fade_power 2\n"
            "  photons {{ reflection on refraction on }}\n}}\n",
            text(fade));
    }

    void writeMaterial(std::uint32_t index) {
        const scene::Material& material = scene_.materials[index];
        if (scene::isReceiver(material.kind)) {
            writeReceiver(index);
        } else if (material.kind == scene::MaterialKind::mirror) {
            pov_ += fmt::format(
                "#declare {} = texture {{\n  pigment {{ rgb 0 }}\n"
                "  finish {{ ambient 0 diffuse 0 reflection {{ {} }} }}\n}}\n",
                exporter_.materialIdentifier(index), colorOf(glm::dvec3(material.albedo)));
        } else {
            writeDielectric(index);
        }
        if (material.normalMap >= 0) {
            exporter_.leaveOut(fmt::format("material '{}'", material.name),
                               "its normal map; POV-Ray has bumps alone");
        }
    }

    void writeReceiver(std::uint32_t index) {
        const scene::Material& material = scene_.materials[index];
        const Picture picture = exporter_.albedoPicture(index, PictureFormat::exr, false);
        std::string pigment = colorOf(glm::dvec3(material.albedo));
        if (picture.kind == PictureKind::file) {
            // Interpolation looks up texel centres by whole numbers there.
            pigment =
                fmt::format("uv_mapping image_map {{ exr \"{}\" {} }} scale {}", picture.file,
                            picture.isSmooth ? "interpolate 2" : "", text(picture.repeatUnits));
        }
        pov_ += fmt::format(
            "#declare {} = texture {{\n  pigment {{ {} }}\n"
            "  finish {{ ambient 0 diffuse 1 }}\n}}\n",
            exporter_.materialIdentifier(index), pigment);
        if (exporter_.emits(index)) {
            exporter_.leaveOut(fmt::format("material '{}'", material.name),
                               "its emission; a mesh is no lamp of POV-Ray's photons");
        }
    }

    void writeDielectric(std::uint32_t index) {
        const scene::Material& material = scene_.materials[index];
        std::string interior = fmt::format("ior {}", text(double(material.ior)));
        const glm::dvec3 absorption(material.absorptionPerMeter);
        const double most = std::max({absorption.r, absorption.g, absorption.b});
        if (most > 0.0) {
            // From 1000 on it is exp(-(1 - fade_color) depth / fade_distance).
            interior += fmt::format(" fade_power 1001 fade_distance {} fade_color {}",
                                    text(1.0 / most), colorOf(1.0 - absorption / most));
        }
        if (most > 0.0) {
            exporter_.change(fmt::format("material '{}'", material.name),
                             "light that ends on something inside it is not absorbed: POV-Ray "
                             "fades it only where it comes out");
        }
        if (material.dispersion != glm::vec4(0.0f)) {
            const double ratio = scene::indexAt(material, scene::dispersionPlace(400.0)) /
                                 scene::indexAt(material, scene::dispersionPlace(700.0));
            interior += fmt::format(" dispersion {} dispersion_samples 24", text(ratio));
            exporter_.change(
                fmt::format("material '{}'", material.name),
                "it disperses by the ratio of its indices at the ends of the spectrum");
        }
        pov_ += fmt::format(
            "#declare {} = material {{\n  texture {{\n    pigment {{ rgbt <1, 1, 1, 1> }}\n"
            "    finish {{ ambient 0 diffuse 0 reflection {{ 0, 1 fresnel on }} conserve_energy "
            "}}\n  }}\n  interior {{ {} }}\n}}\n",
            exporter_.materialIdentifier(index), interior);
    }

    void writeObject(const WorldMesh& mesh) {
        const std::string file = fmt::format("meshes/{}.inc", mesh.identifier);
        exporter_.write(file, mesh2Of(mesh));
        const scene::Material& material = scene_.materials[mesh.material];
        const std::string name = exporter_.materialIdentifier(mesh.material);
        pov_ += fmt::format("#include \"{}\"\nobject {{\n  {}\n", file, mesh.identifier);
        if (scene::isReceiver(material.kind)) {
            // Objects with a bump or two sides are lit where they are seen.
            pov_ += fmt::format("  texture {{ {} }}\n", name);
        } else if (material.kind == scene::MaterialKind::mirror) {
            pov_ += fmt::format(
                "  texture {{ {} }}\n  photons {{ target reflection on refraction off collect off "
                "}}\n",
                name);
        } else {
            pov_ += fmt::format(
                "  material {{ {} }}\n  photons {{ target reflection on refraction on collect off "
                "}}\n  #ifndef (Shoot) no_image #end\n",
                name);
        }
        pov_ += "}\n";
    }

    static std::string mesh2Of(const WorldMesh& mesh) {
        std::string out = fmt::format("#declare {} = mesh2 {{\n", mesh.identifier);
        const auto list = [&](const char* what, std::size_t count, const auto& entry) {
            out += fmt::format("  {} {{\n    {}", what, count);
            for (std::size_t i = 0; i < count; ++i)
                out += ",\n    " + entry(i);
            out += "\n  }\n";
        };
        list("vertex_vectors", mesh.positions.size(), [&](std::size_t i) {
            return fmt::format("<{:.9g},{:.9g},{:.9g}>", mesh.positions[i].x, mesh.positions[i].y,
                               mesh.positions[i].z);
        });
        list("normal_vectors", mesh.normals.size(), [&](std::size_t i) {
            return fmt::format("<{:.9g},{:.9g},{:.9g}>", mesh.normals[i].x, mesh.normals[i].y,
                               mesh.normals[i].z);
        });
        list("uv_vectors", mesh.uvs.size(), [&](std::size_t i) {
            return fmt::format("<{:.9g},{:.9g}>", mesh.uvs[i].x, mesh.uvs[i].y);
        });
        list("face_indices", mesh.triangles.size(), [&](std::size_t i) {
            const glm::uvec3& t = mesh.triangles[i];
            return fmt::format("<{},{},{}>", t.x, t.y, t.z);
        });
        return out + "}\n";
    }

    Exporter& exporter_;
    const scene::Scene& scene_;
    scene::Bounds bounds_;
    std::string pov_;
};

}  // namespace

void exportPovray(Exporter& exporter) {
    PovrayScene(exporter).run();
}

}  // namespace kaustik::exporters
