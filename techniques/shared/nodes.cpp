// SPDX-License-Identifier: MIT
#include "techniques/shared/nodes.h"

#include "framework/pipeline/stage_params.h"

namespace kaustik {

void registerSharedNodes(Registry& registry) {
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

    registry.sharedParams<LayersStage, LayersParams>();
    registry.sharedParams<EmitStage, EmitParams>();
    registry.sharedParams<RefineStage, RefineParams>();
    registry.sharedParams<SpecularStage, SpecularParams>();
    registry.sharedParams<TraceStage, TraceParams>();
    registry.sharedParams<ReconstructStage, ReconstructParams>();
    registry.sharedParams<ViewStage, ViewParams>();

    registerHeightField(registry);
    registerEyeSurfaces(registry);
    registerDenseDriver(registry);
    registerGridEmission(registry);
    registerVertexEmission(registry);
    registerSpecularAuto(registry);
    registerSpecularInterface(registry);
    registerShadowMap(registry);
    registerSpecularSplit(registry);
    registerNoFilter(registry);
    registerScreenGather(registry);
    registerNoTemporal(registry);
    registerTemporalReprojection(registry);
    registerNoBlur(registry);
    registerInterfaceView(registry);
    registerPicture(registry);
}

}  // namespace kaustik
