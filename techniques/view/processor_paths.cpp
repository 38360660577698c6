// SPDX-License-Identifier: MIT
#include "techniques/view/processor_paths.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "framework/reference/eye_path.h"
#include "framework/reference/light_transport.h"
#include "framework/reference/shadow_rays.h"
#include "framework/scene/light_paths.h"
#include "techniques/tracing/processor_eye.h"

namespace kaustik {
namespace {

using reference::mediumIndex;
using reference::SurfaceHit;

struct EyePath {
    reference::Ray ray;
    glm::dvec3 share{1.0};  // without 1/n²
    bool isFromEye = true;  // it has met nothing yet
    int interfaces = 0;     // of dielectrics that it has hit
    int refractions = 0;
    int reflections = 0;  // total ones
    int mirrors = 0;
    double meters = 0.0;  // long
    float ending = transport::kPathExited;
};

// Follows the paths of pixels one after the other, as shaders/view/bvh.comp does.
class Follower {
  public:
    Follower(const reference::EmbreeScene& scene, const ProcessorEye& eye,
             std::span<const glm::vec4> receivers, const BvhViewParams& caps,
             const std::vector<bool>& isOpen, int lights)
        : scene_(scene),
          eye_(eye),
          receivers_(receivers),
          caps_(caps),
          isOpen_(isOpen),
          shadowRays_(scene),
          lights_(lights) {
        const glm::dvec3 extent = scene.bounds().maximum - scene.bounds().minimum;
        rounding_ =
            4.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) * glm::length(extent);
    }

    void followThrough(const glm::dvec2& place) {
        const auto firstEnd = static_cast<float>(found_.ends.size());
        waiting_.assign(1, pathThrough(place));
        indexAtEye_ = 1.0;
        bool isFirst = true;
        PathsOfPixel paths;
        while (!waiting_.empty()) {
            EyePath path = std::move(waiting_.back());
            waiting_.pop_back();
            const std::optional<SurfaceHit> receiver = follow(path);
            if (isFirst) noteExit(path, paths);
            isFirst = false;
            addEnd(path, receiver);
        }
        paths.firstEnd = firstEnd;
        paths.ends = static_cast<float>(found_.ends.size()) - firstEnd;
        found_.pixels.push_back(paths);
    }
    [[nodiscard]] FoundPaths take() { return std::move(found_); }

  private:
    [[nodiscard]] EyePath pathThrough(const glm::dvec2& place) const {
        const ProcessorEye::Ray ray = eye_.rayThrough(place);
        EyePath path;
        path.ray.origin = ray.origin;
        path.ray.direction = ray.direction;
        path.ray.sides = reference::SideRule::any;
        path.meters = eye_.view().nearMeters * ray.perDepth;
        return path;
    }
    [[nodiscard]] const scene::Material& materialOf(std::uint32_t index) const {
        return scene_.scene().materials[index];
    }
    [[nodiscard]] bool isInsideClosed(const reference::MediaStack& media) const {
        return media.inner() != 0 && !isOpen_[media.inner() - 1];
    }

    // An eye that looks at a dielectric from within is inside of it.
    void meetFirst(EyePath& path, const SurfaceHit& hit) {
        path.isFromEye = false;
        path.ray.sides = reference::SideRule::transport;
        path.ray.reachMeters = rounding_;
        const bool isDielectric = materialOf(hit.material).kind == scene::MaterialKind::dielectric;
        if (isDielectric && glm::dot(path.ray.direction, hit.geometricNormal) > 0.0)
            path.ray.media.enter(hit.material + 1);
        indexAtEye_ = mediumIndex(scene_.scene(), path.ray.media.inner());
    }

    // At a dielectric: the path goes on refracted, or totally reflected; the other branch waits
    // where it is to be followed.
    void bend(EyePath& path, const SurfaceHit& hit, const reference::Branches& branches) {
        const bool enters = glm::dot(path.ray.direction, hit.geometricNormal) < 0.0;
        ++path.interfaces;
        if (branches.reflectance >= 1.0) {
            ++path.reflections;
            path.ray.direction = branches.reflected;
            return;
        }
        if (path.interfaces <= caps_.branches && branches.reflectance > 0.0) {
            EyePath& reflected = waiting_.emplace_back(path);
            reflected.ray.direction = branches.reflected;
            reflected.share *= branches.reflectance;
        }
        ++path.refractions;
        path.ray.direction = branches.refracted;
        path.share *= 1.0 - branches.reflectance;
        reference::MediaStack& media = path.ray.media;
        if (!enters) {
            media.leave(hit.material + 1);
        } else if (media.isFull()) {
            path.ending = transport::kPathNestingLimit;
        } else {
            media.enter(hit.material + 1);
        }
    }

    // Of a surface before and behind; of no use at a mirror.
    [[nodiscard]] reference::Branches branchesAt(const EyePath& path, const SurfaceHit& hit,
                                                 bool isMirror) const {
        const reference::MediaStack& media = path.ray.media;
        const auto index = [&](std::uint32_t medium) {
            return mediumIndex(scene_.scene(), medium);
        };
        const double before = index(media.inner());
        double behind = before;
        if (glm::dot(path.ray.direction, hit.geometricNormal) < 0.0) {
            behind = index(hit.material + 1);
        } else if (media.inner() == hit.material + 1) {
            behind = index(media.outer());
        }
        return reference::branchesAt(hit, path.ray.direction, before, behind, isMirror);
    }

    // To the receiver that the path sees in the end; none: it leaves the scene, or ends.
    std::optional<SurfaceHit> follow(EyePath& path) {
        while (true) {
            SurfaceHit hit;
            if (!scene_.intersect(path.ray, hit)) {
                if (isInsideClosed(path.ray.media)) path.ending = transport::kPathLost;
                return std::nullopt;
            }
            if (path.isFromEye) meetFirst(path, hit);
            const scene::Material& material = materialOf(hit.material);
            path.share *= transmittance(path.ray.media.inner(), hit.distance);
            path.meters += hit.distance;
            if (isReceiver(material.kind)) return hit;
            const bool isMirror = material.kind == scene::MaterialKind::mirror;
            const reference::Branches branches = branchesAt(path, hit, isMirror);
            path.ray.origin = hit.position;
            path.ray.start = hit.triangle;
            if (isMirror) {
                if (path.mirrors >= caps_.mirrors) path.ending = transport::kPathMirrorLimit;
                ++path.mirrors;
                path.ray.direction = branches.reflected;
                path.share *= glm::dvec3(material.albedo);
            } else {
                bend(path, hit, branches);
            }
            if (path.reflections > caps_.reflections) path.ending = transport::kPathReflectionLimit;
            if (path.refractions > caps_.interfaces) path.ending = transport::kPathEndedInside;
            if (path.ending != transport::kPathExited) return std::nullopt;
        }
    }

    // Extinction may be infinite, for a black tint; none of it, or no length, leaves all.
    [[nodiscard]] glm::dvec3 transmittance(std::uint32_t medium, double meters) const {
        glm::dvec3 left(1.0);
        if (medium == 0) return left;
        const glm::dvec3 extinction(materialOf(medium - 1).absorptionPerMeter);
        for (int c = 0; c < 3; ++c) {
            const double depth = extinction[c] * meters;
            if (depth > 0.0) left[c] = std::exp(-depth);
        }
        return left;
    }

    void noteExit(const EyePath& path, PathsOfPixel& paths) const {
        const int surfaces = path.interfaces + path.mirrors;
        paths.exitPositionVs = eye_.position(path.ray.origin);
        paths.surfaces = static_cast<float>(surfaces);
        // At a silhouette the ray may pass what the picture has there.
        if (surfaces == 0) return;
        paths.exitDirection = eye_.direction(path.ray.direction);
        paths.ending = path.ending;
    }

    void addEnd(const EyePath& path, const std::optional<SurfaceHit>& receiver) {
        reference::MediaStack media = path.ray.media;
        // What was not traced out of an object is taken to see what one outside of it would.
        while (!receiver && isInsideClosed(media))
            media.leave(media.inner());
        const std::uint32_t medium = media.inner();
        const double ratio = indexAtEye_ / mediumIndex(scene_.scene(), medium);
        PathEnd& end = found_.ends.emplace_back();
        end.direction = eye_.direction(path.ray.direction);
        end.medium = static_cast<float>(medium);
        end.share = ratio * ratio * path.share;
        const auto words = static_cast<std::size_t>((lights_ + 31) / 32);
        found_.lit.resize(found_.lit.size() + words, 0);
        if (!receiver) return;
        end.positionVs = eye_.position(receiver->position);
        end.material = static_cast<float>(receiver->material + 1);
        const bool isUnderWater = medium != 0 && isOpen_[medium - 1] && path.refractions > 0;
        end.depthUnderWater = isUnderWater ? static_cast<float>(-eye_.position(path.ray.origin).z)
                                           : std::numeric_limits<float>::max();
        end.shading = eye_.direction(receiver->shadingNormal);
        end.geometric = eye_.direction(receiver->geometricNormal);
        end.u = static_cast<float>(receiver->uv.x);
        end.v = static_cast<float>(receiver->uv.y);
        end.uvOfPixel = static_cast<float>(eye_.view().footprintPerMeter() * path.meters *
                                           scene_.uvPerMeter(receiver->triangle));
        if (isSurelyShown(*receiver, path.ray.direction)) return;
        noteLights(*receiver, path.ray.direction, found_.lit.data() + found_.lit.size() - words);
    }

    // Whether the light of the receiver is taken from the picture
    // (shaders/view/seen_receiver.glsl): by the pixel that it lies in, and with a margin, so that
    // roundings do not matter.
    [[nodiscard]] bool isSurelyShown(const SurfaceHit& hit, const glm::dvec3& direction) const {
        const glm::dvec3 position = eye_.position(hit.position);
        const glm::dvec3 normal = eye_.direction(hit.geometricNormal);
        const bool isFront = glm::dot(direction, hit.geometricNormal) < 0.0;
        const std::optional<glm::dvec2> place = pixelOf(eye_.view(), position);
        if (!place || isFront != (glm::dot(position, normal) < 0.0)) return false;
        const glm::dvec2 pixel = glm::floor(*place);
        const glm::dvec2 size(eye_.view().width, eye_.view().height);
        const bool isOnScreen = -position.z > 1.001 * eye_.view().nearMeters &&
                                glm::all(glm::greaterThanEqual(pixel, glm::dvec2(0.0))) &&
                                glm::all(glm::lessThan(pixel, size));
        if (!isOnScreen) return false;
        const auto texel = static_cast<std::size_t>(pixel.y * size.x + pixel.x);
        const double depth = static_cast<double>(receivers_[texel].x);
        if (!(depth > 0.0)) return false;
        const glm::dvec3 shown = depth * eye_.viewing(pixel + 0.5);
        const double reach = 2.0 * eye_.view().footprintPerMeter() * -position.z;
        return std::abs(glm::dot(normal, shown - position)) < 0.9 * reach;
    }

    // From the side of a sheet that is looked at.
    void noteLights(const SurfaceHit& hit, const glm::dvec3& direction, std::uint32_t* lit) const {
        const bool isBack = glm::dot(direction, hit.geometricNormal) >= 0.0;
        const double side = isBack && isOpen_[hit.material] ? -1.0 : 1.0;
        for (int i = 0; i < lights_; ++i) {
            const scene::Light& light = scene_.scene().lights[static_cast<std::size_t>(i)];
            const reference::WayToLight way =
                reference::wayTo(light, hit.position, scene_.center());
            const glm::dvec3 facing = side * hit.geometricNormal;
            if (!(way.meters > 0.0) || glm::dot(facing, way.direction) <= 0.0 ||
                side * glm::dot(hit.shadingNormal, way.direction) <= 0.0 ||
                shadowRays_.isBlocked(hit, facing, way.direction, way.meters)) {
                continue;
            }
            lit[i / 32] |= std::uint32_t{1} << (i % 32);
        }
    }

    const reference::EmbreeScene& scene_;
    const ProcessorEye& eye_;
    std::span<const glm::vec4> receivers_;
    const BvhViewParams& caps_;
    const std::vector<bool>& isOpen_;
    reference::ShadowRays shadowRays_;
    int lights_;
    double rounding_;          // of positions, m
    double indexAtEye_ = 1.0;  // of what is around it
    std::vector<EyePath> waiting_;
    FoundPaths found_;
};

}  // namespace

TracesPaths::TracesPaths(ProcessorScene scene, const BvhViewParams& caps, int lights)
    : scene_(std::move(scene)),
      caps_(caps),
      lights_(lights),
      isOpen_(openMaterials(scene_.scene->scene())) {}

FoundPaths TracesPaths::find(const render::RasterView& eye, const LookedThrough& at) const {
    constexpr std::size_t kAtOnce = 64;
    const std::span<const std::uint32_t> pixels = at.pixels;
    const ProcessorEye processorEye(*scene_.scene, eye);
    std::vector<FoundPaths> parts((pixels.size() + kAtOnce - 1) / kAtOnce);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
        Follower follower(*scene_.scene, processorEye, at.receivers, caps_, isOpen_, lights_);
        const std::size_t end = std::min((part + 1) * kAtOnce, pixels.size());
        for (std::size_t i = part * kAtOnce; i < end; ++i) {
            const glm::dvec2 pixel(pixels[i] & 0xffffu, pixels[i] >> 16u);
            follower.followThrough(pixel + 0.5 + glm::dvec2(at.offset));
        }
        parts[part] = follower.take();
    });
    FoundPaths found;
    std::size_t ends = 0;
    for (const FoundPaths& part : parts)
        ends += part.ends.size();
    found.pixels.reserve(pixels.size());
    found.ends.reserve(ends);
    for (FoundPaths& part : parts) {
        for (PathsOfPixel& paths : part.pixels)
            paths.firstEnd += static_cast<float>(found.ends.size());
        const auto append = [](auto& to, const auto& from) {
            to.insert(to.end(), from.begin(), from.end());
        };
        append(found.pixels, part.pixels);
        append(found.ends, part.ends);
        append(found.lit, part.lit);
    }
    return found;
}

}  // namespace kaustik
