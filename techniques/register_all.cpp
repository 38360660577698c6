// SPDX-License-Identifier: MIT
#include "techniques/register_all.h"

#include "framework/pipeline/stage_params.h"
#include "techniques/bibliography.h"
#include "techniques/eye_rays/view_params.h"
#include "techniques/generators/around_stage.h"
#include "techniques/light_cells/refine_stage.h"
#include "techniques/raster_views/map_params.h"

namespace kaustik {

#define NODE(name) void register##name(Registry& registry);
#define TECHNIQUE(name) void register##name(Registry& registry);
#include "techniques/registered.inc"
#undef NODE
#undef TECHNIQUE

namespace {

// The order of lists, and the parameters that all nodes of a stage share.
void registerStages(Registry& registry) {
    // In the order in which buildFrame() asks for them.
    registry.stage<GeometryStage>();
    registry.stage<EyeStage>();
    registry.stage<LayersStage>();
    registry.stage<ShadowStage>();
    registry.stage<DriverStage>();
    registry.stage<EmitStage>();
    registry.stage<RefineStage>();
    registry.stage<SpecularStage>();
    registry.stage<AroundStage>();
    registry.stage<TraceStage>();
    registry.stage<ReconstructStage>();
    registry.stage<MediaStage>();
    registry.stage<BlurStage>();
    registry.stage<FilterStage>();
    registry.stage<GatherStage>();
    registry.stage<TemporalStage>();
    registry.stage<ViewStage>();
    registry.stage<ComposeStage>();

    registry.sharedParams<EyeStage, EyeParams>();
    registry.sharedParams<LayersStage, LayersParams>();
    registry.sharedParams<EmitStage, EmitParams>();
    registry.sharedParams<RefineStage, RefineParams>();
    registry.sharedParams<SpecularStage, SpecularParams>();
    registry.sharedParams<TraceStage, TraceParams>();
    registry.sharedParams<ReconstructStage, ReconstructParams>();
    registry.sharedParams<ViewStage, ViewParams>();
}

}  // namespace

Registry registerAll() {
    Registry registry;
    registerStages(registry);
    registerPapers(registry);
#define NODE(name) register##name(registry);
#define TECHNIQUE(name) register##name(registry);
#include "techniques/registered.inc"
#undef NODE
#undef TECHNIQUE
    return registry;
}

}  // namespace kaustik
