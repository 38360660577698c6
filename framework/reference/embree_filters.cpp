// SPDX-License-Identifier: MIT
#include "framework/reference/embree_filters.h"

#include <cmath>
#include <glm/glm.hpp>

namespace kaustik::reference {
namespace {

using scene::MaterialKind;

bool isStart(const FilterContext& context, const RTCHit& hit) {
    return hit.primID == context.start.triangle && hit.geomID == context.start.object;
}

// For rays to lights, of which there are several.
void rejectOwnPlane(const FilterContext& context, const RTCFilterFunctionNArguments* arguments) {
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] != -1) continue;
        const glm::vec3 normal(RTCHitN_Ng_x(arguments->hit, n, i),
                               RTCHitN_Ng_y(arguments->hit, n, i),
                               RTCHitN_Ng_z(arguments->hit, n, i));
        const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, n, i),
                                  RTCRayN_dir_y(arguments->ray, n, i),
                                  RTCRayN_dir_z(arguments->ray, n, i));
        const float closing = std::abs(glm::dot(normal, direction));
        const float resolved = context.resolvedMeters[RTCRayN_id(arguments->ray, n, i)];
        if (RTCRayN_tfar(arguments->ray, n, i) * closing <= resolved * glm::length(normal))
            arguments->valid[i] = 0;
    }
}

}  // namespace

void rejectWrongSide(const RTCFilterFunctionNArguments* arguments) {
    const auto& context = *reinterpret_cast<const FilterContext*>(arguments->context);
    // Nothing is rejected; of several rays at once, which no other rule is asked of.
    if (context.sides == SideRule::any && !context.start.exists()) return;
    const auto& info = *static_cast<const EmbreeScene::ObjectInfo*>(arguments->geometryUserPtr);
    const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
    const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
    if (isStart(context, hit)) {
        arguments->valid[0] = 0;
        return;
    }
    if (context.sides == SideRule::any) return;
    const float closing = ray.dir_x * hit.Ng_x + ray.dir_y * hit.Ng_y + ray.dir_z * hit.Ng_z;
    const float size = std::sqrt(hit.Ng_x * hit.Ng_x + hit.Ng_y * hit.Ng_y + hit.Ng_z * hit.Ng_z);
    const bool leaves = closing > 0.0f;
    const bool isNear = ray.tfar * std::abs(closing) <= context.reachMeters * size;
    bool isHit = true;
    if (info.kind == MaterialKind::dielectric) {
        const std::uint32_t medium = info.material + 1;
        const bool isInner = context.media->inner() == medium;
        isHit = leaves ? isInner || (!isNear && context.media->holds(medium)) : !isInner;
    } else if (info.closed) {
        isHit = !leaves;
    } else if (isNear) {
        isHit = context.leftSide != (leaves ? transport::kLeftOutside : transport::kLeftInside);
    }
    if (!isHit) arguments->valid[0] = 0;
}

void rejectStart(const RTCFilterFunctionNArguments* arguments) {
    const auto& context = *reinterpret_cast<const FilterContext*>(arguments->context);
    if (context.resolvedMeters != nullptr) return rejectOwnPlane(context, arguments);
    const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
    if (isStart(context, hit)) arguments->valid[0] = 0;
}

}  // namespace kaustik::reference
