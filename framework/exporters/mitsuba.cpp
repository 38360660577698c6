// SPDX-License-Identifier: MIT
// A scene for Mitsuba 3. Its camera looks along its own +z with +x to the left; meshes are PLY,
// where a picture's first row is at v = 0; an index of refraction has the air around it as 1.000277
// unless it is told otherwise.
#include <fmt/format.h>

#include "framework/exporters/parts.h"

namespace kaustik::exporters {
namespace {

std::string escaped(const std::string& text) {
    std::string out;
    for (const char letter : text) {
        switch (letter) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += letter;
        }
    }
    return out;
}

std::string rgb(const char* name, const glm::dvec3& color) {
    return fmt::format("<rgb name=\"{}\" value=\"{}\"/>", name, text(color, ", "));
}

std::string number(const char* name, double value) {
    return fmt::format("<float name=\"{}\" value=\"{}\"/>", name, text(value));
}

class MitsubaScene {
  public:
    explicit MitsubaScene(Exporter& exporter) : exporter_(exporter), scene_(exporter.scene) {}

    void run() {
        line(0, "<scene version=\"3.0.0\">");
        line(1, fmt::format("<!-- {}: metres; colours are linear Rec.709; radiance is W/m²/sr -->",
                            escaped(scene_.name)));
        line(
            1,
            "<integrator type=\"ptracer\"><integer name=\"max_depth\" value=\"32\"/></integrator>");
        if (scene_.medium) writeMedium();
        writeSensor();
        for (std::uint32_t i = 0; i < scene_.materials.size(); ++i) {
            if (exporter_.isUsed(i)) writeMaterial(i);
        }
        for (const scene::Light& light : exporter_.lights())
            writeLight(light);
        for (const WorldMesh& mesh : exporter_.meshes())
            writeShape(mesh);
        line(0, "</scene>");
        exporter_.writeScene("scene.xml", xml_, "mitsuba -m scalar_rgb scene.xml -o theirs.exr");
    }

  private:
    void line(int depth, const std::string& text) {
        xml_ += std::string(static_cast<std::size_t>(4 * depth), ' ') + text + "\n";
    }

    void writeMedium() {
        const scene::Medium& medium = *scene_.medium;
        line(1, "<medium type=\"homogeneous\" id=\"medium_of_scene\">");
        const glm::dvec3 scattering(medium.scatteringPerMeter);
        const glm::dvec3 extinction = scattering + glm::dvec3(medium.absorptionPerMeter);
        writeExtinction(extinction, scattering);
        line(2, fmt::format("<phase type=\"hg\">{}</phase>",
                            number("g", static_cast<double>(medium.anisotropy))));
        line(1, "</medium>");
    }

    void writeExtinction(const glm::dvec3& extinction, const glm::dvec3& scattering) {
        glm::dvec3 albedo(0.0);
        for (glm::length_t c = 0; c < 3; ++c)
            albedo[c] = extinction[c] > 0.0 ? scattering[c] / extinction[c] : 0.0;
        line(2, rgb("sigma_t", extinction));
        line(2, rgb("albedo", albedo));
    }

    void writeSensor() {
        const Axes eye = exporter_.camera();
        const glm::dmat4 toWorld(glm::dvec4(-eye.right, 0.0), glm::dvec4(eye.up, 0.0),
                                 glm::dvec4(eye.forward, 0.0), glm::dvec4(eye.position, 1.0));
        std::string matrix;
        for (glm::length_t row = 0; row < 4; ++row) {
            for (glm::length_t column = 0; column < 4; ++column)
                matrix +=
                    fmt::format("{}{}", matrix.empty() ? "" : " ", text(toWorld[column][row]));
        }
        line(1, "<sensor type=\"perspective\">");
        line(2, fmt::format("<transform name=\"to_world\"><matrix value=\"{}\"/></transform>",
                            matrix));
        line(2, number("fov", scene_.camera.verticalFovDegrees));
        line(2, "<string name=\"fov_axis\" value=\"y\"/>");
        line(2, number("near_clip", scene_.camera.nearMeters));
        line(2, fmt::format("<film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/><integer "
                            "name=\"height\" value=\"{}\"/><rfilter type=\"box\"/></film>",
                            exporter_.request.width, exporter_.request.height));
        const long long pixels =
            static_cast<long long>(exporter_.request.width) * exporter_.request.height;
        line(2, fmt::format("<sampler type=\"independent\"><integer name=\"sample_count\" "
                            "value=\"{}\"/></sampler>",
                            std::max(1LL, exporter_.request.photons / pixels)));
        if (scene_.medium) line(2, "<ref name=\"medium\" id=\"medium_of_scene\"/>");
        line(1, "</sensor>");
    }

    std::string surfaceColor(std::uint32_t index) {
        const scene::Material& material = scene_.materials[index];
        const Picture picture = exporter_.albedoPicture(index, PictureFormat::exr, true);
        if (picture.kind == PictureKind::none)
            return rgb("reflectance", glm::dvec3(material.albedo));
        const double scale = 1.0 / picture.repeatUnits;
        const std::string repeats = fmt::format(
            "<transform name=\"to_uv\"><scale x=\"{0}\" y=\"{0}\"/></transform>", text(scale));
        if (picture.kind == PictureKind::checker) {
            return fmt::format(
                "<texture name=\"reflectance\" type=\"checkerboard\">{}{}{}</texture>",
                rgb("color0", glm::dvec3(material.albedo)),
                rgb("color1", glm::dvec3(material.patternAlbedo)), repeats);
        }
        return fmt::format(
            "<texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" "
            "value=\"{}\"/><string name=\"filter_type\" value=\"{}\"/>{}</texture>",
            picture.file, picture.isSmooth ? "bilinear" : "nearest", repeats);
    }

    void writeMaterial(std::uint32_t index) {
        const scene::Material& material = scene_.materials[index];
        const std::string subject = fmt::format("material '{}'", material.name);
        const std::string id = exporter_.materialIdentifier(index);
        if (scene::isReceiver(material.kind)) {
            line(1, fmt::format("<bsdf type=\"twosided\" id=\"{}\">", id));
            line(2, fmt::format("<bsdf type=\"diffuse\">{}</bsdf>", surfaceColor(index)));
            line(1, "</bsdf>");
            return;
        }
        const bool isMirror = material.kind == scene::MaterialKind::mirror;
        std::string surface =
            isMirror ? fmt::format(
                           "type=\"conductor\"{{}}><string name=\"material\" "
                           "value=\"none\"/>{}</bsdf>",
                           rgb("specular_reflectance", glm::dvec3(material.albedo)))
                     : fmt::format("type=\"dielectric\"{{}}>{}{}</bsdf>",
                                   number("int_ior", static_cast<double>(material.ior)),
                                   number("ext_ior", 1.0));
        const std::string withId = fmt::format(" id=\"{}\"", id);
        if (material.normalMap >= 0) {
            line(1, fmt::format("<bsdf type=\"normalmap\"{}>", withId));
            line(2, fmt::format("<texture name=\"normalmap\" type=\"bitmap\"><string "
                                "name=\"filename\" value=\"{}\"/><boolean name=\"raw\" "
                                "value=\"true\"/></texture>",
                                exporter_.normalMapFile(index, PictureFormat::exr)));
            line(2, "<bsdf " + fmt::format(fmt::runtime(surface), ""));
            line(1, "</bsdf>");
        } else {
            line(1, "<bsdf " + fmt::format(fmt::runtime(surface), withId));
        }
        if (material.dispersion != glm::vec4(0.0f))
            exporter_.leaveOut(subject, "its dispersion; its index is that of the d line");
        if (!isMirror && material.absorptionPerMeter != glm::vec3(0.0f)) {
            line(1, fmt::format("<medium type=\"homogeneous\" id=\"inside_{}\">", id));
            writeExtinction(glm::dvec3(material.absorptionPerMeter), glm::dvec3(0.0));
            line(1, "</medium>");
        }
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
            line(1, fmt::format("<emitter type=\"directional\"><vector name=\"direction\" "
                                "value=\"{}\"/>{}</emitter>",
                                text(light.direction, ", "), rgb("irradiance", power)));
            return;
        }
        if (light.kind == scene::LightKind::point) {
            line(1, fmt::format("<emitter type=\"point\"><point name=\"position\" "
                                "value=\"{}\"/>{}</emitter>",
                                text(light.position, ", "), rgb("intensity", power)));
            return;
        }
        exporter_.change(subject, "between its cones it fades evenly with the angle");
        if (light.image >= 0) exporter_.leaveOut(subject, "the picture that it projects");
        line(1, "<emitter type=\"spot\">");
        line(2,
             fmt::format("<transform name=\"to_world\"><lookat origin=\"{}\" target=\"{}\" "
                         "up=\"{}\"/></transform>",
                         text(light.position, ", "), text(light.position + light.direction, ", "),
                         text(scene::defaultTopOfImage(light.direction), ", ")));
        line(2, rgb("intensity", power));
        line(2, number("cutoff_angle", glm::degrees(static_cast<double>(light.outerConeRadians))));
        line(2, number("beam_width", glm::degrees(static_cast<double>(light.innerConeRadians))));
        line(1, "</emitter>");
    }

    void writeShape(const WorldMesh& mesh) {
        const scene::Material& material = scene_.materials[mesh.material];
        const MeshFile written = exporter_.writeMesh(mesh, true);
        line(1, fmt::format("<shape type=\"ply\" id=\"{}\">", mesh.identifier));
        line(2, fmt::format("<string name=\"filename\" value=\"{}\"/>", written.file));
        line(2, fmt::format("<ref id=\"{}\"/>", written.material));
        if (written.isEmitter) {
            line(2, fmt::format("<emitter type=\"area\">{}</emitter>",
                                rgb("radiance", glm::dvec3(material.emission))));
        }
        if (written.hasAbsorbingInterior)
            line(2, fmt::format("<ref name=\"interior\" id=\"inside_{}\"/>", written.material));
        if (scene_.medium) line(2, "<ref name=\"exterior\" id=\"medium_of_scene\"/>");
        line(1, "</shape>");
    }

    Exporter& exporter_;
    const scene::Scene& scene_;
    std::string xml_;
};

}  // namespace

void exportMitsuba(Exporter& exporter) {
    MitsubaScene(exporter).run();
}

}  // namespace kaustik::exporters
