// SPDX-License-Identifier: MIT
#include "framework/run/judge_work.h"

#include <fmt/format.h>

#include "framework/core/error.h"
#include "framework/image/image.h"
#include "framework/judge/acceptance.h"
#include "framework/judge/pictures.h"
#include "framework/measure/image_file.h"

namespace kaustik::run {

void requireNumbers(const Image& image, const std::string& name) {
    judge::requireNumbers(judge::threeChannels(image), name);
}

}  // namespace kaustik::run

#ifdef KAUSTIK_HAS_EMBREE

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>

#include "framework/core/files.h"
#include "framework/reference/direct_view.h"
#include "framework/reference/embree_scene.h"
#include "framework/reference/path_census.h"
#include "framework/reference/wrong_fresnel.h"
#include "framework/run/reference_work.h"
#include "framework/scene/emitters.h"
#include "framework/scene/texture.h"

namespace kaustik::run {
namespace {

namespace fs = std::filesystem;
using judge::Cause;
using judge::CauseKind;

// Points that stand for a light that has a size, in direct light.
constexpr int kLightPoints = 64;
constexpr double kIndexStep = 0.01;
constexpr double kTurnDegrees = 0.25;
constexpr double kMoveShare = 0.005;  // of the distance to what is specular
// Each picture takes a reference of its own, of a quarter of the photons: six times that of the
// scene's own are as much as someone waits for.
constexpr std::size_t kMaxPictures = 24;

// The light of a scene as radiance.
struct Lit {
    reference::DirectView view;
    std::vector<judge::Light> classes;
    Image caustics;  // all classes, radiance
};

Image timesFill(const Image& irradiance, const Image& fill) {
    Image result = irradiance;
    for (std::size_t i = 0; i < result.values.size(); ++i)
        result.values[i] *= fill.values[i];
    return result;
}

// Of direct and of caustic light together.
Image changeOf(const Lit& other, const Lit& usual) {
    Image result = other.caustics;
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        result.values[i] +=
            other.view.direct.values[i] - usual.caustics.values[i] - usual.view.direct.values[i];
    }
    return result;
}

// A file that is gone with its object, also where what reads it throws.
class TemporaryFile {
  public:
    explicit TemporaryFile(fs::path path) : path_(std::move(path)) {}
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

// Deals references out to shards: each to the one that has the fewest photons so far.
class Deal {
  public:
    explicit Deal(const Shard& shard) : own_(shard.number - 1), photons_(shard.count, 0) {}
    // Whether the next reference is the shard's own.
    [[nodiscard]] bool takes(long long photons) {
        const auto least = std::min_element(photons_.begin(), photons_.end());
        *least += photons;
        const bool isOwn = least == photons_.begin() + static_cast<std::ptrdiff_t>(own_);
        ++dealt_.all;
        dealt_.own += isOwn ? 1 : 0;
        return isOwn;
    }
    [[nodiscard]] PreparedReferences dealt() const { return dealt_; }

  private:
    std::uint64_t own_;
    std::vector<long long> photons_;  // by shard
    PreparedReferences dealt_;
};

class Lighting {
  public:
    // With a deal references are only made, those that it says yes to, and light is of no picture.
    Lighting(const JudgedScene& request, const Watch* watch, Deal* deal)
        : request_(request), watch_(watch), deal_(deal) {}

    // `scene` must outlive the call alone.
    [[nodiscard]] Lit lightOf(const scene::Scene& scene, bool inClasses, long long photons) const {
        if (deal_ != nullptr && !deal_->takes(photons)) return {};
        const reference::EmbreeScene embree(scene);
        const reference::Reference found = referenceOf(embree, inClasses, photons);
        if (deal_ != nullptr) return {};
        Lit lit;
        reference::DirectViewRequest view;
        view.width = request_.width;
        view.height = request_.height;
        lit.view = reference::traceDirectView(embree, view);
        lit.caustics = timesFill(found.irradiance, lit.view.fill);
        for (const reference::ClassImages& of : found.classes) {
            lit.classes.push_back({of.name, timesFill(of.irradiance, lit.view.fill),
                                   timesFill(of.irradianceError, lit.view.fill)});
        }
        if (inClasses && lit.classes.empty()) {
            lit.classes.push_back(
                {"other", lit.caustics, timesFill(found.irradianceError, lit.view.fill)});
        }
        return lit;
    }

    // Of the irradiance, as changesByWrongFresnel() has them.
    [[nodiscard]] std::array<Image, reference::kWrongFresnels.size()> changesByFresnel(
        const scene::Scene& scene, long long photons) const {
        if (deal_ != nullptr) return {};
        const reference::EmbreeScene embree(scene);
        reference::WrongFresnelRequest request;
        request.width = request_.width;
        request.height = request_.height;
        request.photons = static_cast<std::uint64_t>(photons);
        request.seed = static_cast<std::uint64_t>(request_.seed);
        request.shouldContinue = [this] {
            return watch_ != nullptr ? watch_->shouldContinue() : !isInterrupted();
        };
        std::array<Image, reference::kWrongFresnels.size()> changes =
            reference::changesByWrongFresnel(embree, request);
        if (!request.shouldContinue()) throw Error("The judge was interrupted.", kExitFailed);
        return changes;
    }

  private:
    [[nodiscard]] reference::Reference referenceOf(const reference::EmbreeScene& embree,
                                                   bool inClasses, long long photons) const {
        reference::ReferenceRequest request;
        request.width = request_.width;
        request.height = request_.height;
        request.seed = static_cast<std::uint64_t>(request_.seed);
        if (inClasses) {
            reference::ClassOrder order;
            order.count = request_.classes;
            request.classes = reference::chooseClasses(embree, request, order, "class", "classes");
        }
        reference::RunOptions options;
        options.stop.photons = static_cast<std::uint64_t>(photons);
        return watch_ != nullptr ? obtainReference(embree, request, options, *watch_)
                                 : obtainReference(embree, request, options);
    }

    const JudgedScene& request_;
    const Watch* watch_;
    Deal* deal_;
};

class Causes {
  public:
    Causes(const scene::Scene& scene, const Lighting& lighting, long long photons)
        : scene_(scene),
          lighting_(lighting),
          photons_(photons),
          usual_(lighting.lightOf(scene, false, photons)) {}

    [[nodiscard]] std::vector<Cause> all() {
        for (std::size_t i = 0; i < scene_.materials.size(); ++i)
            addIndex(i);
        addFresnel();
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            if (scene_.lights[i].emitter < 0 && scene_.lights[i].band == 0) addLight(i);
        }
        for (std::size_t i = 0; i < scene_.objects.size(); ++i)
            addNormals(i);
        return std::move(causes_);
    }

  private:
    using Change = std::function<void(scene::Scene&)>;

    [[nodiscard]] Lit changed(const Change& change) const {
        scene::Scene other = scene_;
        change(other);
        return lighting_.lightOf(other, false, photons_);
    }
    [[nodiscard]] bool isFull() const { return causes_.size() >= kMaxPictures; }

    void add(CauseKind kind, std::string name, std::string sentence, std::string unit,
             double amount, double least, Image radiance) {
        Cause cause;
        cause.kind = kind;
        cause.name = std::move(name);
        cause.sentence = std::move(sentence);
        cause.unit = std::move(unit);
        cause.amount = amount;
        cause.least = least;
        cause.radiance = std::move(radiance);
        causes_.push_back(std::move(cause));
    }

    // The same photons in both, so that their noise goes with the difference.
    void addAmounts(const std::string& name, const std::string& unit,
                    const std::vector<double>& amounts, double least,
                    const std::function<void(scene::Scene&, double)>& change) {
        if (isFull()) return;
        for (const double amount : amounts) {
            const Lit other = changed([&](scene::Scene& scene) { change(scene, amount); });
            add(CauseKind::amount, name, "", unit, amount, least, changeOf(other, usual_));
        }
    }

    void addWhole(const std::string& name, const std::string& sentence, const Change& change) {
        if (isFull()) return;
        add(CauseKind::whole, name, sentence, "", 0.0, 0.0, changeOf(changed(change), usual_));
    }

    void addIndex(std::size_t index) {
        const scene::Material& material = scene_.materials[index];
        const bool isUsed =
            std::any_of(scene_.objects.begin(), scene_.objects.end(),
                        [&](const scene::Object& object) { return object.material == index; });
        if (!isUsed || material.kind != scene::MaterialKind::dielectric ||
            static_cast<double>(material.ior) < 1.0 + 4.0 * kIndexStep)
            return;
        addAmounts(fmt::format("the index of refraction of '{}'", material.name), "",
                   {-kIndexStep, kIndexStep, -3.0 * kIndexStep, 3.0 * kIndexStep}, 0.002,
                   [index](scene::Scene& scene, double step) {
                       scene.materials[index].ior += static_cast<float>(step);
                   });
    }

    // How light is divided where it meets a dielectric; all of them alike, as a program does it.
    void addFresnel() {
        const bool hasDielectric = std::any_of(
            scene_.objects.begin(), scene_.objects.end(), [&](const scene::Object& object) {
                return scene_.materials[object.material].kind == scene::MaterialKind::dielectric;
            });
        if (!hasDielectric) return;
        const std::array<Image, reference::kWrongFresnels.size()> changes =
            lighting_.changesByFresnel(scene_, photons_);
        constexpr std::array<std::pair<const char*, const char*>, 3> kNames = {
            {{"fresnel:lossless",
              "refracted light has not Fresnel's factor: what is reflected is not taken from it"},
             {"fresnel:schlick",
              "light is divided by Schlick's approximation and not by Fresnel's equations"},
             {"fresnel:swapped", "Fresnel's equations have the two indices exchanged"}}};
        static_assert(kNames.size() == reference::kWrongFresnels.size());
        for (std::size_t i = 0; i < changes.size(); ++i) {
            add(CauseKind::whole, kNames[i].first, kNames[i].second, "", 0.0, 0.0,
                timesFill(changes[i], usual_.view.fill));
        }
    }

    [[nodiscard]] glm::dvec3 middleOfSpecular() const {
        const scene::Bounds bounds = scene::specularBounds(scene_);
        return 0.5 * (bounds.minimum + bounds.maximum);
    }

    void addLight(std::size_t index) {
        const scene::Light& light = scene_.lights[index];
        const bool isDirectional = light.kind == scene::LightKind::directional;
        const glm::dvec3 along =
            isDirectional ? light.direction : glm::normalize(middleOfSpecular() - light.position);
        const glm::dvec3 other =
            std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        const glm::dvec3 first = glm::normalize(glm::cross(other, along));
        const glm::dvec3 second = glm::cross(along, first);
        for (const glm::dvec3& axis : {first, second}) {
            const std::string towards =
                fmt::format("({:.2f}, {:.2f}, {:.2f})", axis.x, axis.y, axis.z);
            if (isDirectional) {
                addAmounts(
                    fmt::format("the direction of light '{}', towards {},", light.name, towards),
                    "degrees", {-kTurnDegrees, kTurnDegrees}, 0.05,
                    [index, axis](scene::Scene& scene, double step) {
                        glm::dvec3& direction = scene.lights[index].direction;
                        direction = glm::normalize(direction + std::tan(glm::radians(step)) * axis);
                    });
            } else {
                const double distance = glm::length(middleOfSpecular() - light.position);
                addAmounts(fmt::format("the place of light '{}', towards {},", light.name, towards),
                           "m", {-kMoveShare * distance, kMoveShare * distance}, 0.001 * distance,
                           [index, axis](scene::Scene& scene, double step) {
                               scene.lights[index].position += step * axis;
                           });
            }
        }
    }

    void addNormals(std::size_t index) {
        const scene::Object& object = scene_.objects[index];
        const scene::Material& material = scene_.materials[object.material];
        if (scene::isReceiver(material.kind)) return;
        const scene::Mesh& mesh = scene_.meshes[object.mesh];
        if (material.normalMap >= 0) addGreen(object);
        if (mesh.heightField && !mesh.heightField->waves.empty()) {
            addWhole("normals of '" + object.name + "'",
                     fmt::format("the normals of '{}' are flipped: they lean the wrong way, with "
                                 "their horizontal part negated",
                                 object.name),
                     [index](scene::Scene& scene) {
                         scene::Mesh& own = ownMesh(scene, index);
                         own.heightField.reset();
                         for (glm::vec3& normal : own.normals)
                             normal = {-normal.x, normal.y, -normal.z};
                     });
            return;
        }
        if (!mesh.closed || material.kind != scene::MaterialKind::dielectric) return;
        addWhole("normals of '" + object.name + "'",
                 fmt::format("the normals of '{}' are flipped: its inside is taken for its "
                             "outside, and its index for 1/n",
                             object.name),
                 [index](scene::Scene& scene) {
                     scene::Mesh& own = ownMesh(scene, index);
                     for (glm::vec3& normal : own.normals)
                         normal = -normal;
                     for (glm::uvec3& triangle : own.triangles)
                         std::swap(triangle.y, triangle.z);
                 });
    }

    // The object's mesh, which no other object has.
    static scene::Mesh& ownMesh(scene::Scene& scene, std::size_t index) {
        scene.meshes.push_back(scene.meshes[scene.objects[index].mesh]);
        scene.objects[index].mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
        return scene.meshes.back();
    }

    // Formats differ in whether a normal map's green points up or down in the picture.
    void addGreen(const scene::Object& object) {
        const auto place = static_cast<std::size_t>(scene_.materials[object.material].normalMap);
        if (!greens_.insert(place).second || isFull()) return;
        Image map = scene::decodeTexture(scene_.images[place]);
        for (std::size_t i = 0; i < map.values.size(); ++i)
            map.values[i] = 0.5f + (i % 3 == 1 ? -0.5f : 0.5f) * map.values[i];
        const TemporaryFile file(
            unfinishedPath(cacheFolder() / fmt::format("green{}", floatImageExtension())));
        fs::create_directories(file.path().parent_path());
        writeImage(file.path(), map);
        addWhole("green of the normal map of '" + object.name + "'",
                 fmt::format("the normal map of '{}' is flipped: its green points down the picture "
                             "instead of up",
                             object.name),
                 [&](scene::Scene& scene) {
                     scene.images[place].file = file.path();
                     scene.images[place].bytes.clear();
                 });
    }

    const scene::Scene& scene_;
    const Lighting& lighting_;
    long long photons_;
    Lit usual_;
    std::vector<Cause> causes_;
    std::set<std::size_t> greens_;
};

judge::Subject litSubject(const scene::Scene& given, const JudgedScene& request, const Watch* watch,
                          Deal* deal) {
    if (given.medium) {
        throw ConfigError(fmt::format(
            "judge: {} is in a medium, whose light on the way to the eye references of irradiance "
            "do not hold.",
            given.name));
    }
    if (request.photons < 2 * (1LL << 18)) {
        throw ConfigError(fmt::format("--photons: {} is less than the {} of two batches.",
                                      request.photons, 2 * (1LL << 18)));
    }
    scene::Scene scene = given;
    scene.ambientIrradiance = glm::vec3(0.0f);
    scene::placeLightPoints(scene, kLightPoints, request.height);
    const Lighting lighting(request, watch, deal);
    Lit lit = lighting.lightOf(scene, true, request.photons);
    judge::Subject subject;
    subject.scene = scene.name;
    subject.verticalFovDegrees = scene.camera.verticalFovDegrees;
    subject.direct = std::move(lit.view.direct);
    subject.fill = std::move(lit.view.fill);
    subject.mask = std::move(lit.view.isPlain);
    subject.hasGlass = std::move(lit.view.hasGlass);
    subject.classes = std::move(lit.classes);
    for (const scene::Material& material : scene.materials) {
        if (material.kind == scene::MaterialKind::dielectric)
            subject.indices.push_back({material.name, static_cast<double>(material.ior)});
    }
    if (request.causes) {
        const long long photons = std::max(request.photons / 4, 2 * (1LL << 18));
        subject.causes = Causes(scene, lighting, photons).all();
    }
    return subject;
}

}  // namespace

judge::Subject subjectOf(const scene::Scene& scene, const JudgedScene& request,
                         const Watch* watch) {
    return litSubject(scene, request, watch, nullptr);
}

PreparedReferences prepareReferences(const scene::Scene& scene, const JudgedScene& request,
                                     const Shard& shard, const Watch* watch) {
    Deal deal(shard);
    static_cast<void>(litSubject(scene, request, watch, &deal));
    return deal.dealt();
}

judge::Verdict judgeFile(const scene::Scene& scene, const std::string& file,
                         const std::string& errorFile, JudgedScene request, bool hasSize,
                         const judge::JudgeOptions& options) {
    if (measure::isDisplayPicture(file)) {
        throw ConfigError(
            fmt::format("{} was made for a display; save linear light as .exr or .pfm.", file));
    }
    Image theirs = readImage(file);
    if (!hasSize) {
        request.width = theirs.width;
        request.height = theirs.height;
    }
    Image error;
    if (!errorFile.empty()) {
        error = readImage(errorFile);
        if (error.width != theirs.width || error.height != theirs.height) {
            throw ConfigError(fmt::format("{} and {} are not of the same size.", errorFile, file));
        }
    }
    requireNumbers(theirs, file);
    judge::Subject subject = subjectOf(scene, request);
    subject.theirsName = file;
    subject.theirs = std::move(theirs);
    subject.theirsError = std::move(error);
    return judge::judge(subject, options);
}

}  // namespace kaustik::run

#else

namespace kaustik::run {

judge::Subject subjectOf(const scene::Scene&, const JudgedScene&, const Watch*) {
    throw ConfigError("This program was built without Embree and cannot judge pictures.");
}

PreparedReferences prepareReferences(const scene::Scene& scene, const JudgedScene& request,
                                     const Shard&, const Watch* watch) {
    static_cast<void>(subjectOf(scene, request, watch));
    return {};
}

judge::Verdict judgeFile(const scene::Scene& scene, const std::string&, const std::string&,
                         JudgedScene request, bool, const judge::JudgeOptions&) {
    static_cast<void>(subjectOf(scene, request));
    return {};
}

}  // namespace kaustik::run

#endif
