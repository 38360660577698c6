// SPDX-License-Identifier: MIT
#include "techniques/reconstruct/processor_patches.h"

#include <tbb/blocked_range.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "framework/transport/coverage.h"
#include "framework/transport/seen.h"

namespace kaustik {

using glm::ivec2;
using glm::vec2;
using glm::vec3;
using namespace transport;

namespace {

// Whole units; none of what is negative or not a number. (Rounding down is a call of a function
// where a processor need not have more than SSE2, and a conversion is none.)
std::uint64_t wholeOf(float units) {
    constexpr float kMost = 9e18f;
    return units > 0.0f
               ? static_cast<std::uint64_t>(static_cast<std::int64_t>(std::min(units, kMost)))
               : 0;
}

// A place on the screen, px, as a whole number; where it is far from the picture, or not a number,
// one next to it.
int floorNear(float place, int size) {
    constexpr int kAway = 2;
    const float bounded = place > static_cast<float>(-kAway)
                              ? std::min(place, static_cast<float>(size + kAway))
                              : static_cast<float>(-kAway);
    return static_cast<int>(bounded + static_cast<float>(kAway)) - kAway;
}

struct Patch {
    vec3 corners[4];
    float densities[4];
    float first;
    PatchSide side;
    vec3 flux;
    float tolerance;
    bool isJoined, isAlone;
};

Patch unpacked(const PatchData& data) {
    Patch made;
    for (int i = 0; i < 4; ++i) {
        made.corners[i] = vec3(data.corners[i]);
        made.densities[i] = data.corners[i].w;
    }
    const auto bits = static_cast<std::uint32_t>(data.flux.w);
    made.first = data.normal.w;
    made.side = {vec3(data.normal), vec3(data.direction), (bits & kPatchIsFromBehind) != 0};
    made.flux = vec3(data.flux);
    made.tolerance = data.direction.w;
    made.isJoined = (bits & kPatchIsJoined) != 0;
    made.isAlone = (bits & kPatchIsAlone) != 0;
    return made;
}

struct PatchTriangle {
    ScreenTriangle onScreen;
    vec3 weightsX, weightsY, weightsBegin, changes;
    vec3 plane, middle;
    float perArea;
    vec3 densities;
    bool isShaded;
    [[nodiscard]] vec3 weightsAt(const vec2& place) const {
        return weightsX * place.x + weightsY * place.y + weightsBegin;
    }
    [[nodiscard]] bool contains(const vec2& place) const {
        const vec3 weights = weightsAt(place);
        return weights.x >= 0.0f && weights.y >= 0.0f && weights.z >= 0.0f;
    }
    // What it has of a square, 1/m².
    [[nodiscard]] float partOf(const vec2& corner, float square) const {
        vec3 weights = weightsAt(corner + 0.5f * square);
        const vec3 change = square * changes;
        if (weights.x <= -change.x || weights.y <= -change.y || weights.z <= -change.z) return 0.0f;
        float covered = 1.0f;
        if (weights.x < change.x || weights.y < change.y || weights.z < change.z) {
            covered = coverageOf(onScreen, corner, 1.0f / square);
            if (covered <= 0.0f) return 0.0f;
            weights = glm::max(weights, 0.0f);
            weights /= weights.x + weights.y + weights.z;
        }
        return covered * perArea * glm::dot(weights, densities);
    }
};

struct PatchOnScreen {
    PatchTriangle triangles[2];
    vec2 base;        // pixel that the triangles' corners count from
    ivec2 low, high;  // the rectangle of pixels that may be covered; none where it is empty
    bool isWhole;
};

// What a pixel sees where a plane of a patch's surface would be, m² of the plane.
struct PlanePixel {
    float lit = 0.0f, occluded = 0.0f, inView = 0.0f, stored = 0.0f;
};

// Of so many pixels that one sum in 32 bits would be wrong by parts in a thousand.
struct PatchParts {
    double on = 0.0, occluded = 0.0, inView = 0.0, stored = 0.0;
};

// Where a patch has put a part of it: a pixel, or ~ a square of pixels.
struct KeptPlace {
    std::int32_t place;
    float stored;
};

// Of one thread.
class Coverer {
  public:
    Coverer(const SeenPixels& pixels, TriangleShading shading, const PatchSums& sums,
            bool booksLedger)
        : pixels_(pixels), shading_(shading), sums_(sums), booksLedger_(booksLedger) {}
    void cover(const Patch& whole);
    [[nodiscard]] const LedgerSums& ledger() const { return ledger_; }

  private:
    [[nodiscard]] PatchTriangle patchTriangle(const Patch& whole, const int (&corners)[3],
                                              const vec2 (&places)[4], float part,
                                              const vec2& base) const;
    [[nodiscard]] PatchOnScreen onScreen(const Patch& whole) const;
    [[nodiscard]] ivec2 spanOf(const PatchOnScreen& onto, float bottom, float top) const;
    // `place`: on the screen, px.
    void addSeen(PlanePixel& pixel, const vec2& place, const SeenPixels::Receiver& seen,
                 const PatchTriangle& of, const Patch& whole, bool isAway, float share,
                 float storedArea) const;
    // Of the square with this lower left corner, by what is seen at one place in it.
    void addPlace(PlanePixel& sum, const PatchOnScreen& onto, const Patch& whole,
                  const vec2& corner, float square, const vec2& place,
                  const SeenPixels::Receiver& seen, bool isAtEdge, float storedArea) const;
    [[nodiscard]] PlanePixel partIn(const ivec2& pixel, const PatchOnScreen& onto,
                                    const Patch& whole) const;
    void addToPixels(const PatchOnScreen& onto, const Patch& whole);
    void addToSquares(const PatchOnScreen& onto, const Patch& whole);
    void keep(std::int32_t place, const PlanePixel& sum);
    [[nodiscard]] PlanePixel seenOnPlane(const ivec2& pixel, const Patch& whole,
                                         const vec3& middle) const;
    void depositNear(const Patch& whole);
    void deposit(std::int32_t place, const vec3& flux) const;
    void book(std::uint32_t account, const vec3& flux);
    void bookExcess(const Patch& whole, float share);

    const SeenPixels& pixels_;
    TriangleShading shading_;
    PatchSums sums_;
    bool booksLedger_;
    LedgerSums ledger_{};
    // Of the patch.
    std::vector<KeptPlace> kept_;
    PatchParts parts_;
};

PatchTriangle Coverer::patchTriangle(const Patch& whole, const int (&corners)[3],
                                     const vec2 (&places)[4], float part, const vec2& base) const {
    const vec3 a = whole.corners[corners[0]], b = whole.corners[corners[1]],
               c = whole.corners[corners[2]];
    PatchTriangle made;
    made.onScreen =
        triangleOf(places[corners[0]] - base, places[corners[1]] - base, places[corners[2]] - base);
    const ScreenTriangle& at = made.onScreen;
    const vec3 x(at.b.y - at.c.y, at.c.y - at.a.y, at.a.y - at.b.y);
    const vec3 y(at.c.x - at.b.x, at.a.x - at.c.x, at.b.x - at.a.x);
    const vec3 begin = -x * vec3(at.b.x, at.c.x, at.a.x) - y * vec3(at.b.y, at.c.y, at.a.y);
    const float scale = 0.5f / at.area;
    made.weightsX = scale * x;
    made.weightsY = scale * y;
    made.weightsBegin = scale * begin;
    made.changes = 0.5f * (glm::abs(made.weightsX) + glm::abs(made.weightsY));
    const vec3 area = glm::cross(b - a, c - a);
    const float size = glm::length(area);
    const vec3 edges = glm::abs(b - a) + glm::abs(c - a);
    const bool isFlat = size > kMinFlatness * glm::dot(edges, edges);
    made.plane = isFlat ? area / size : whole.side.normal;
    if (std::abs(glm::dot(made.plane, whole.side.normal)) < kMinPlaneCosine)
        made.plane = whole.side.normal;
    made.middle = (a + b + c) / 3.0f;
    const vec3 middleRay = pixels_.ray(pixels_.pixelOf(made.middle));
    const float covered =
        std::abs(at.area) * pixels_.pixelArea(middleRay, -made.middle.z, made.plane);
    made.perArea =
        part / std::max(isFlat ? std::max(0.5f * size, kMinOfCovered * covered) : covered, 1e-30f);
    const vec3 densities(whole.densities[corners[0]], whole.densities[corners[1]],
                         whole.densities[corners[2]]);
    const float mean = (densities.x + densities.y + densities.z) / 3.0f;
    const float minimum = std::min({densities.x, densities.y, densities.z});
    const float maximum = std::max({densities.x, densities.y, densities.z});
    const bool isSmooth =
        (shading_ == TriangleShading::smooth ? maximum <= kMaxDensityRatio * minimum
                                             : shading_ == TriangleShading::vertices) &&
        mean > 0.0f;
    made.densities = isSmooth ? densities / mean : vec3(1.0f);
    made.isShaded = whole.isJoined && shading_ != TriangleShading::smooth;
    return made;
}

PatchOnScreen Coverer::onScreen(const Patch& whole) const {
    vec2 places[4];
    for (int i = 0; i < 4; ++i)
        places[i] = pixels_.pixelOf(whole.corners[i]);
    const vec2 minimum = glm::min(glm::min(places[0], places[1]), glm::min(places[2], places[3])) -
                         2.0f * kMinHeight;
    const vec2 maximum = glm::max(glm::max(places[0], places[1]), glm::max(places[2], places[3])) +
                         2.0f * kMinHeight;
    PatchOnScreen made;
    made.base = {std::floor(minimum.x), std::floor(minimum.y)};
    const ivec2& size = pixels_.size();
    const ivec2 begin(floorNear(minimum.x, size.x), floorNear(minimum.y, size.y));
    const ivec2 end(floorNear(maximum.x, size.x), floorNear(maximum.y, size.y));
    made.low = glm::max(begin, 0);
    made.high = glm::min(end, size - 1);
    made.isWhole = made.low == begin && made.high == end;
    made.triangles[0] = patchTriangle(whole, {0, 1, 2}, places, whole.first, made.base);
    made.triangles[1] = patchTriangle(whole, {0, 2, 3}, places, 1.0f - whole.first, made.base);
    return made;
}

// The first and the last pixel between two heights that can be covered, before they are held to the
// rectangle; none where x > y.
ivec2 Coverer::spanOf(const PatchOnScreen& onto, float bottom, float top) const {
    const vec2 heights = vec2(bottom, top) - onto.base.y;
    vec2 span(1e9f, -1e9f);
    for (const PatchTriangle& triangle : onto.triangles)
        span = spanWith(span, triangle.onScreen, heights);
    if (!(span.x <= span.y)) return {1, 0};
    const int width = pixels_.size().x;
    return {std::max(floorNear(span.x + onto.base.x, width), onto.low.x),
            std::min(floorNear(span.y + onto.base.x, width), onto.high.x)};
}

bool seesLitSide(const vec3& position, const PatchSide& side) {
    const bool seesFront = glm::dot(side.normal, position) < 0.0f;
    return seesFront == (glm::dot(side.normal, side.direction) < 0.0f);
}

float boundedSlant(float slant, float minimum) {
    return (slant < 0.0f ? -1.0f : 1.0f) * std::max(std::abs(slant), minimum);
}

void Coverer::addSeen(PlanePixel& pixel, const vec2& place, const SeenPixels::Receiver& seen,
                      const PatchTriangle& of, const Patch& whole, bool isAway, float share,
                      float storedArea) const {
    enum Where { on, occluded, outside };
    const vec3 ray = pixels_.ray(place);
    const float facing = boundedSlant(glm::dot(of.plane, ray), 1e-4f);
    const float depth = std::max(glm::dot(of.plane, of.middle) / facing, pixels_.nearMeters());
    const float tolerance =
        whole.tolerance + std::min(pixels_.depthMargin(ray, depth, of.plane), seen.margin);
    const float seenDepth = std::abs(seen.depth);
    Where where = on;
    if (seenDepth == 0.0f) {
        where = outside;
    } else if (seenDepth < depth - tolerance) {
        where = occluded;
    } else if (seen.depth < 0.0f || seenDepth > depth + tolerance ||
               glm::dot(seen.normal, whole.side.normal) <= kSameSide) {
        where = outside;
    }
    const float area = where == on ? seen.area : pixels_.pixelArea(ray, depth, of.plane);
    vec3 normal = seen.normal;
    if (where == outside && isAway && seesLitSide(ray, whole.side)) {
        where = on;
        normal = whole.side.normal;
    }
    pixel.inView += share * area;
    if (where == occluded) pixel.occluded += share * area;
    if (where != on) return;
    const float lit = share * litShare(normal, of.plane, of.isShaded, whole.side);
    (storedArea > 0.0f ? pixel.lit : pixel.occluded) += lit * area;
    pixel.stored += lit * std::min(storedArea, kMaxStored * area);
}

void Coverer::addPlace(PlanePixel& sum, const PatchOnScreen& onto, const Patch& whole,
                       const vec2& corner, float square, const vec2& place,
                       const SeenPixels::Receiver& seen, bool isAtEdge, float storedArea) const {
    const PatchTriangle& first = onto.triangles[0];
    const PatchTriangle& second = onto.triangles[1];
    const vec2 local = corner - onto.base;
    const float ofFirst = first.partOf(local, square), ofSecond = second.partOf(local, square);
    if (!(ofFirst + ofSecond > 0.0f)) return;
    const vec2 looked = place - onto.base;
    const bool isAway = isAtEdge && !first.contains(looked) && !second.contains(looked);
    addSeen(sum, place, seen, ofFirst >= ofSecond ? first : second, whole, isAway,
            (ofFirst + ofSecond) * square * square, storedArea);
}

PlanePixel Coverer::partIn(const ivec2& pixel, const PatchOnScreen& onto,
                           const Patch& whole) const {
    PlanePixel sum;
    const vec2 corner(pixel);
    const SeenPixels::Pixel& at = pixels_.at(pixel);
    if (at.number == 0) {
        addPlace(sum, onto, whole, corner, 1.0f, corner + 0.5f, at.middle, false, at.middle.area);
        return sum;
    }
    for (int i = 0; i < kEdgeSamples; ++i) {
        addPlace(sum, onto, whole, corner + 0.5f * vec2(i & 1, i >> 1), 0.5f, corner + edgePlace(i),
                 pixels_.sample(at.number, i), true, at.middle.area);
    }
    return sum;
}

void Coverer::keep(std::int32_t place, const PlanePixel& sum) {
    parts_.on += double{sum.lit};
    parts_.occluded += double{sum.occluded};
    parts_.inView += double{sum.inView};
    parts_.stored += double{sum.stored};
    if (sum.stored > 0.0f) kept_.push_back({place, sum.stored});
}

void Coverer::addToPixels(const PatchOnScreen& onto, const Patch& whole) {
    for (int y = onto.low.y; y <= onto.high.y; ++y) {
        const auto bottom = static_cast<float>(y);
        const ivec2 span = spanOf(onto, bottom, bottom + 1.0f);
        for (int x = span.x; x <= span.y; ++x) {
            const ivec2 pixel(x, y);
            keep(static_cast<std::int32_t>(pixels_.indexOf(pixel)), partIn(pixel, onto, whole));
        }
    }
}

void Coverer::addToSquares(const PatchOnScreen& onto, const Patch& whole) {
    constexpr int kSide = kPixelBlockSide;
    for (int row = onto.low.y / kSide; row <= onto.high.y / kSide; ++row) {
        const auto bottom = static_cast<float>(kSide * row);
        const ivec2 span = spanOf(onto, bottom, bottom + kSide);
        if (span.x > span.y) continue;
        for (int column = span.x / kSide; column <= span.y / kSide; ++column) {
            const int index = row * pixels_.blocksOfRow() + column;
            const SeenPixels::Block& block = pixels_.block(static_cast<std::size_t>(index));
            const ivec2 corner = kSide * ivec2(column, row);
            if (!block.several) {
                PlanePixel sum;
                addPlace(sum, onto, whole, vec2(corner), kSide, vec2(corner) + 0.5f * kSide,
                         block.receiver, false, block.receiver.area);
                keep(~index, sum);
                continue;
            }
            const ivec2 low = glm::max(corner, onto.low);
            const ivec2 high = glm::min(corner + kSide - 1, onto.high);
            for (int y = low.y; y <= high.y; ++y) {
                for (int x = low.x; x <= high.x; ++x) {
                    const ivec2 pixel(x, y);
                    keep(static_cast<std::int32_t>(pixels_.indexOf(pixel)),
                         partIn(pixel, onto, whole));
                }
            }
        }
    }
}

void Coverer::deposit(std::int32_t place, const vec3& flux) const {
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::uint64_t units =
            wholeOf(flux[static_cast<int>(channel)] * sums_.unitsPerWatt + 0.5f);
        if (units == 0) continue;
        std::uint64_t& sum = place >= 0
                                 ? sums_.pixels[3 * static_cast<std::size_t>(place) + channel]
                                 : sums_.blocks[static_cast<std::size_t>(~place)].sums[channel];
        std::atomic_ref(sum).fetch_add(units, std::memory_order_relaxed);
    }
}

void Coverer::book(std::uint32_t account, const vec3& flux) {
    if (!booksLedger_) return;
    const float watts = flux.r + flux.g + flux.b;
    if (!std::isfinite(watts) || watts < 0.0f) {
        ++ledger_[kAccountNotANumber].events;
        return;
    }
    const float units = watts * sums_.unitsPerWatt;
    if (units < 0.25f) return;  // nothing, or another batch's
    ledger_[account].units += wholeOf(units);
    ++ledger_[account].events;
}

void Coverer::bookExcess(const Patch& whole, float share) {
    if (share != 0.0f)
        book(share > 0.0f ? kSumMapExcess : kSumMapDeficit, whole.flux * std::abs(share));
}

PlanePixel Coverer::seenOnPlane(const ivec2& pixel, const Patch& whole, const vec3& middle) const {
    PatchTriangle plane;
    plane.plane = whole.side.normal;
    plane.middle = middle;
    plane.isShaded = false;
    PlanePixel made;
    const SeenPixels::Pixel& at = pixels_.at(pixel);
    const vec2 corner(pixel);
    if (at.number == 0) {
        addSeen(made, corner + 0.5f, at.middle, plane, whole, false, 1.0f, at.middle.area);
        return made;
    }
    for (int i = 0; i < kEdgeSamples; ++i) {
        addSeen(made, corner + edgePlace(i), pixels_.sample(at.number, i), plane, whole, false,
                0.25f, at.middle.area);
    }
    return made;
}

void Coverer::depositNear(const Patch& whole) {
    const vec3 middle =
        0.25f * (whole.corners[0] + whole.corners[1] + whole.corners[2] + whole.corners[3]);
    if (-middle.z <= pixels_.nearMeters()) return book(kAccountBehindEye, whole.flux);
    const vec2 at = pixels_.pixelOf(middle);
    const ivec2& size = pixels_.size();
    const bool isInside = at.x >= 0.0f && at.y >= 0.0f && at.x < static_cast<float>(size.x) &&
                          at.y < static_cast<float>(size.y);
    if (!isInside) return book(kAccountOffScreen, whole.flux);
    float nearness[9], stored[9];
    float sum = 0.0f;
    const ivec2 corner = ivec2(at) - 1;
    for (int i = 0; i < 9; ++i) {
        const ivec2 pixel = corner + ivec2(i % 3, i / 3);
        nearness[i] = 0.0f;
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y) continue;
        const PlanePixel seen = seenOnPlane(pixel, whole, middle);
        if (seen.lit <= 0.0f) continue;
        nearness[i] = std::max(1.5f - glm::length(vec2(pixel) + 0.5f - at), 1e-3f);
        stored[i] = seen.stored / seen.lit;
        sum += nearness[i];
    }
    if (!(sum > 0.0f)) {
        const bool seesFront = glm::dot(whole.side.normal, middle) < 0.0f;
        return book(seesFront ? kAccountEdgeOn : kAccountOccludedSplat, whole.flux);
    }
    float excess = 0.0f;
    for (int i = 0; i < 9; ++i) {
        if (!(nearness[i] > 0.0f)) continue;
        const float share = nearness[i] / sum;
        deposit(static_cast<std::int32_t>(pixels_.indexOf(corner + ivec2(i % 3, i / 3))),
                whole.flux * (stored[i] * share));
        excess += (stored[i] - 1.0f) * share;
    }
    bookExcess(whole, excess);
    book(whole.isJoined ? kSumTriangles : kSumBeams, whole.flux);
}

void Coverer::cover(const Patch& whole) {
    for (const vec3& corner : whole.corners) {
        if (!(-corner.z > pixels_.nearMeters())) return book(kAccountBehindEye, whole.flux);
    }
    const PatchOnScreen onto = onScreen(whole);
    kept_.clear();
    parts_ = {};
    const ivec2 size = glm::max(onto.high - onto.low + 1, 0);
    if (whole.isAlone && size.x * size.y > kMaxPixelsOfNarrow) {
        addToSquares(onto, whole);
    } else if (size.x > 0) {
        addToPixels(onto, whole);
    }
    const double outside = onto.isWhole ? 0.0 : std::max(1.0 - parts_.inView, 0.0);
    const double found = parts_.on + parts_.occluded + outside;
    const double beyond = found > 0.0 ? std::max(double{kMinFound} - found, 0.0) : 0.0;
    const double total = found + beyond;
    if (!(total > 0.0)) return depositNear(whole);
    const auto share = [&](double part) { return static_cast<float>(part / total); };
    const double hidden = parts_.occluded + beyond;
    if (parts_.on > 0.0)
        book(whole.isJoined ? kSumTriangles : kSumBeams, whole.flux * share(parts_.on));
    if (hidden > 0.0) book(kAccountOccludedSplat, whole.flux * share(hidden));
    if (outside > 0.0) book(kAccountOffScreen, whole.flux * share(outside));
    if (!(parts_.on > 0.0)) return;
    bookExcess(whole, share(parts_.stored - parts_.on));
    const vec3 flux = whole.flux * share(1.0);
    for (const KeptPlace& place : kept_)
        deposit(place.place, flux * place.stored);
}

}  // namespace

void coverPatches(std::span<const PatchData> patches, const SeenPixels& pixels,
                  TriangleShading shading, const PatchSums& sums, LedgerSums* ledger) {
    // So few at once, since one may cover all of the picture.
    constexpr std::size_t kGrain = 8;
    tbb::combinable<Coverer> coverers(
        [&] { return Coverer(pixels, shading, sums, ledger != nullptr); });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, patches.size(), kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          Coverer& own = coverers.local();
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              const bool isNone = (static_cast<std::uint32_t>(patches[i].flux.w) &
                                                   kPatchIsNone) != 0;
                              if (!isNone) own.cover(unpacked(patches[i]));
                          }
                      });
    if (ledger == nullptr) return;
    coverers.combine_each([&](const Coverer& own) {
        for (std::size_t account = 0; account < ledger->size(); ++account) {
            (*ledger)[account].units += own.ledger()[account].units;
            (*ledger)[account].events += own.ledger()[account].events;
        }
    });
}

}  // namespace kaustik
