// SPDX-License-Identifier: MIT
// The scene's indirect draws once a layer; those of layers beyond the measured depth complexity, of
// the scene or of their own object, draw nothing, so that the processor need not wait for the
// measurement. AFTER_LISTS: where lists hold all fragments none is drawn, nor is the blank triangle
// behind them, which clears for each layer that is peeled.
#include "include/thread.glsl"
#include "framework/transport/types.h"
#ifdef AFTER_LISTS
#include "layered_depth/fragment_lists_fit.glsl"
#endif

struct DrawCommand {
    uint indexCount;
    uint instanceCount;
    uint firstIndex;
    int baseVertex;
    uint baseInstance;
};
layout(std430) readonly buffer SceneCommands {
    DrawCommand sceneCommands[];
};
layout(std430) writeonly buffer LayerCommands {
    DrawCommand layerCommands[];
};
#ifdef PER_OBJECT
layout(std430) readonly buffer Complexities {
    uint complexities[];
};
uniform int layerCount;
#elif !defined(AFTER_LISTS)
layout(std430) readonly buffer Statistics {
    LayerStatistics statistics;
};
uniform int layerCount;
#endif
uniform int commandCount;

void main() {
    int index = int(threadNumber());
#ifdef AFTER_LISTS
    if (index == commandCount * layerCount)
        layerCommands[index] = DrawCommand(3u, listsFit() ? 0u : 1u, 0u, 0, 0u);
#endif
    if (index >= commandCount * layerCount) return;
    DrawCommand command = sceneCommands[index % commandCount];
#ifdef PER_OBJECT
    uint complexity = complexities[index % commandCount];
#else
    uint complexity = statistics.complexity;
#endif
    if (uint(index / commandCount) >= complexity) command.instanceCount = 0u;
#ifdef AFTER_LISTS
    if (listsFit()) command.instanceCount = 0u;
#endif
    layerCommands[index] = command;
}
