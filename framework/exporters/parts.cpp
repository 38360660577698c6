// SPDX-License-Identifier: MIT
#include "framework/exporters/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <set>

#include "framework/core/files.h"
#include "framework/render/view.h"
#include "framework/scene/dispersion.h"
#include "framework/scene/spectrum.h"
#include "framework/scene/texture.h"

namespace kaustik::exporters {
namespace {

// Of its own among `taken`.
std::string identifierOf(const std::string& name, const char* kind, std::set<std::string>& taken) {
    std::string plain = fmt::format("{}_", kind);
    for (const char letter : name)
        plain += std::isalnum(static_cast<unsigned char>(letter)) != 0 ? letter : '_';
    std::string result = plain;
    for (int number = 2; !taken.insert(result).second; ++number)
        result = fmt::format("{}_{}", plain, number);
    return result;
}

double encodeSrgb(double value) {
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

void setTexel(Image& image, int x, int y, const glm::vec3& color) {
    for (int c = 0; c < 3; ++c)
        image.at(x, y, c) = color[c];
}

// The second colour of tiles fills a joint of 0.04 of a tile's side, left and below.
constexpr int kTileTexels = 25;

Image tilesOf(const scene::Material& material) {
    Image image(kTileTexels, kTileTexels, 3);
    for (int y = 0; y < kTileTexels; ++y) {
        for (int x = 0; x < kTileTexels; ++x) {
            const bool isJoint = x == 0 || y == kTileTexels - 1;
            setTexel(image, x, y, isJoint ? material.patternAlbedo : material.albedo);
        }
    }
    return image;
}

Image checkerOf(const scene::Material& material) {
    Image image(2, 2, 3);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 2; ++x)
            setTexel(image, x, y, x == y ? material.patternAlbedo : material.albedo);
    }
    return image;
}

Image enlarged(const Image& image, int times) {
    Image large(image.width * times, image.height * times, 3);
    for (int y = 0; y < large.height; ++y) {
        for (int x = 0; x < large.width; ++x) {
            for (int c = 0; c < 3; ++c)
                large.at(x, y, c) = image.at(x / times, y / times, c);
        }
    }
    return large;
}

template <class T>
void append(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

}  // namespace

Exporter::Exporter(const scene::Scene& from, const ExportRequest& asked)
    : scene(from), request(asked) {
    std::set<std::string> taken;
    for (const scene::Material& material : scene.materials)
        materialIdentifiers_.push_back(identifierOf(material.name, "material", taken));
}

void Exporter::leaveOut(const std::string& subject, const std::string& reason) {
    result.notes.push_back({NoteKind::leftOut, subject, reason});
}

void Exporter::change(const std::string& subject, const std::string& reason) {
    result.notes.push_back({NoteKind::changed, subject, reason});
}

std::vector<scene::Light> Exporter::lights() const {
    std::vector<scene::Light> own;
    for (const scene::Light& light : scene.lights) {
        if (light.emitter < 0 && light.band == 0) own.push_back(light);
    }
    for (const scene::Emitter& emitter : scene.emitters) {
        if (emitter.isDisc()) own.push_back(emitter.light);
    }
    return own;
}

std::vector<WorldMesh> Exporter::meshes() const {
    std::vector<WorldMesh> all;
    std::set<std::string> taken;
    for (const scene::Object& object : scene.objects) {
        const scene::Mesh& mesh = scene.meshes[object.mesh];
        const glm::dmat3 toNormal = glm::transpose(glm::inverse(glm::dmat3(object.toWorld)));
        const glm::dvec2 scale(scene.materials[object.material].uvScale);
        WorldMesh world;
        world.name = object.name;
        world.identifier = identifierOf(object.name, "object", taken);
        world.material = object.material;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::dvec3 position = mesh.origin + glm::dvec3(mesh.positions[i]);
            world.positions.emplace_back(object.toWorld * glm::dvec4(position, 1.0));
            world.normals.push_back(glm::normalize(toNormal * glm::dvec3(mesh.normals[i])));
            world.uvs.push_back(glm::dvec2(mesh.uvs[i]) * scale);
        }
        world.triangles = mesh.triangles;
        all.push_back(std::move(world));
    }
    return all;
}

Axes Exporter::camera() const {
    const render::RasterView view =
        render::makeEyeView(scene.camera, request.width, request.height);
    const glm::dmat3 toWorld = glm::transpose(glm::dmat3(view.worldToView));
    return {scene.camera.position, toWorld[0],        toWorld[1],
            -toWorld[2],           view.halfExtent.x, view.halfExtent.y};
}

std::string Exporter::materialIdentifier(std::uint32_t material) const {
    return materialIdentifiers_[material];
}

MeshFile Exporter::writeMesh(const WorldMesh& mesh, bool flipsV) {
    const scene::Material& material = scene.materials[mesh.material];
    MeshFile written;
    written.file = fmt::format("meshes/{}.ply", mesh.identifier);
    written.material = materialIdentifier(mesh.material);
    written.isEmitter = emits(mesh.material);
    written.hasAbsorbingInterior = material.kind == scene::MaterialKind::dielectric &&
                                   material.absorptionPerMeter != glm::vec3(0.0f);
    write(written.file, plyOf(mesh, flipsV));
    if (written.isEmitter) ++result.lightCount;
    return written;
}

bool Exporter::emits(std::uint32_t material) const {
    return scene.materials[material].emission != glm::vec3(0.0f);
}

bool Exporter::isUsed(std::uint32_t material) const {
    return std::any_of(scene.objects.begin(), scene.objects.end(),
                       [&](const scene::Object& object) { return object.material == material; });
}

Picture Exporter::albedoPicture(std::uint32_t index, PictureFormat format, bool hasChecker) {
    const scene::Material& material = scene.materials[index];
    const bool isChecker = material.pattern == scene::Pattern::checker;
    if (material.pattern == scene::Pattern::none && material.image < 0) return {};
    const double repeat = isChecker ? 2.0 : 1.0;
    if (isChecker && hasChecker && material.image < 0)
        return {PictureKind::checker, "", false, repeat};
    Picture picture{PictureKind::file, "", material.image >= 0, repeat};
    Image image;
    if (material.image >= 0) {
        if (material.pattern != scene::Pattern::none) {
            change(fmt::format("material '{}'", material.name),
                   "it has its picture, and not its pattern too");
            picture.repeatUnits = 1.0;
        }
        image = scene::decodeTexture(scene.images[static_cast<std::size_t>(material.image)]);
        for (std::size_t i = 0; i < image.values.size(); ++i)
            image.values[i] *= material.albedo[static_cast<glm::length_t>(i % 3)];
    } else {
        image = isChecker ? checkerOf(material) : tilesOf(material);
    }
    picture.file = fmt::format("pictures/{}.{}", materialIdentifier(index),
                               format == PictureFormat::exr ? "exr" : "png");
    if (format == PictureFormat::png) {
        // Whoever blurs between texels is to blur little.
        if (material.image < 0) image = enlarged(image, isChecker ? 32 : 10);
        for (float& value : image.values)
            value = static_cast<float>(encodeSrgb(static_cast<double>(value)));
    }
    write(picture.file, image);
    return picture;
}

std::string Exporter::normalMapFile(std::uint32_t index, PictureFormat format) {
    const scene::Material& material = scene.materials[index];
    Image image = scene::decodeTexture(scene.images[static_cast<std::size_t>(material.normalMap)]);
    for (std::size_t i = 0; i < image.values.size(); i += 3) {
        glm::vec3 vector(image.values[i] * material.normalScale,
                         image.values[i + 1] * material.normalScale, image.values[i + 2]);
        if (glm::length(vector) > 0.0f) vector = glm::normalize(vector);
        for (std::size_t c = 0; c < 3; ++c)
            image.values[i + c] = 0.5f + 0.5f * vector[static_cast<glm::length_t>(c)];
    }
    const std::string file = fmt::format("pictures/{}_normals.{}", materialIdentifier(index),
                                         format == PictureFormat::exr ? "exr" : "png");
    write(file, image);
    return file;
}

void Exporter::write(const std::string& file, const std::string& text) {
    writeFileWhole(request.folder / file, text);
    ++result.fileCount;
}

void Exporter::write(const std::string& file, const Image& image) {
    std::filesystem::create_directories((request.folder / file).parent_path());
    writeImage(request.folder / file, image);
    ++result.fileCount;
}

void Exporter::writeScene(const std::string& file, const std::string& text,
                          const std::string& command) {
    write(file, text);
    result.sceneFile = request.folder / file;
    result.renderCommand = command;
    result.objectCount = scene.objects.size();
}

void Exporter::noteSurroundings() {
    if (scene.ambientIrradiance != glm::vec3(0.0f)) {
        leaveOut("ambient_irradiance",
                 "it fills shadows in the picture here, and is no light of the scene");
    }
    if (scene.environmentLights) {
        leaveOut("environment", "it shines here, and its picture is not written");
    } else if (scene.backgroundRadiance != glm::vec3(0.0f)) {
        leaveOut("background_radiance", "it is only seen here, and there it would shine");
    }
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        const scene::Material& material = scene.materials[i];
        if (material.kind == scene::MaterialKind::glossy && isUsed(i)) {
            leaveOut(fmt::format("material '{}'", material.name),
                     "its glossy lobe; it is as diffuse as its albedo");
        }
    }
}

std::string text(double number) {
    // -0 would be another text for the same.
    return fmt::format("{}", number == 0.0 ? 0.0 : number);
}

std::string text(const glm::dvec3& numbers, const char* between) {
    return text(numbers.x) + between + text(numbers.y) + between + text(numbers.z);
}

std::string plyOf(const WorldMesh& mesh, bool flipsV) {
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float "
        "y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty "
        "float u\nproperty float v\nelement face {}\nproperty list uchar int "
        "vertex_indices\nend_header\n",
        mesh.positions.size(), mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        for (const glm::dvec3& vector : {mesh.positions[i], mesh.normals[i]}) {
            for (glm::length_t c = 0; c < 3; ++c)
                append(bytes, static_cast<float>(vector[c]));
        }
        append(bytes, static_cast<float>(mesh.uvs[i].x));
        append(bytes, static_cast<float>(flipsV ? 1.0 - mesh.uvs[i].y : mesh.uvs[i].y));
    }
    for (const glm::uvec3& triangle : mesh.triangles) {
        append(bytes, std::uint8_t{3});
        for (glm::length_t c = 0; c < 3; ++c)
            append(bytes, static_cast<std::int32_t>(triangle[c]));
    }
    return bytes;
}

std::optional<double> abbeNumberOf(const scene::Material& material) {
    if (material.dispersion == glm::vec4(0.0f)) return std::nullopt;
    constexpr double kHydrogenF = 486.1327;
    constexpr double kHydrogenC = 656.2725;
    const double blue = scene::indexAt(material, scene::dispersionPlace(kHydrogenF));
    const double red = scene::indexAt(material, scene::dispersionPlace(kHydrogenC));
    if (!(blue > red)) return std::nullopt;
    return (static_cast<double>(material.ior) - 1.0) / (blue - red);
}

}  // namespace kaustik::exporters
