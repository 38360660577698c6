// SPDX-License-Identifier: MIT
// Embree 3 or 4, whichever CMake has found, or in a build without it whichever has its headers
// there. They differ in how a query hands its context on to the filters; everything else that is
// used here has the same names and means the same.
#pragma once

#if defined(KAUSTIK_EMBREE_MAJOR) ? KAUSTIK_EMBREE_MAJOR == 3 : !__has_include(<embree4/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace kaustik::reference {

#if RTC_VERSION_MAJOR == 3

using QueryContext = RTCIntersectContext;

inline void initQueryContext(QueryContext& context) {
    rtcInitIntersectContext(&context);
}

inline void findFirstHit(RTCScene scene, QueryContext& context, RTCRayHit& query) {
    rtcIntersect1(scene, &context, &query);
}

// Of rays next to each other; those that count have -1 in `valid`.
inline void findFirstHits(RTCScene scene, QueryContext& context, const int* valid,
                          RTCRayHit8& query) {
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect8(valid, scene, &context, &query);
}

inline void findAnyHit(RTCScene scene, QueryContext& context, RTCRay& ray) {
    rtcOccluded1(scene, &context, &ray);
}

inline void findAnyHits(RTCScene scene, QueryContext& context, const int* valid, RTCRay8& query) {
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded8(valid, scene, &context, &query);
}

#else

using QueryContext = RTCRayQueryContext;

inline void initQueryContext(QueryContext& context) {
    rtcInitRayQueryContext(&context);
}

inline void findFirstHit(RTCScene scene, QueryContext& context, RTCRayHit& query) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &query, &arguments);
}

inline void findFirstHits(RTCScene scene, QueryContext& context, const int* valid,
                          RTCRayHit8& query) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect8(valid, scene, &query, &arguments);
}

inline void findAnyHit(RTCScene scene, QueryContext& context, RTCRay& ray) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &ray, &arguments);
}

inline void findAnyHits(RTCScene scene, QueryContext& context, const int* valid, RTCRay8& query) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcOccluded8(valid, scene, &query, &arguments);
}

#endif

}  // namespace kaustik::reference
