// SPDX-License-Identifier: MIT
// The scene's indirect draws once a layer; those of layers deeper than their own object draw nothing.
layout(local_size_x = 64) in;

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
layout(std430) readonly buffer Complexities {
    uint complexities[];
};
uniform int commandCount;
uniform int layerCount;

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= commandCount * layerCount) return;
    DrawCommand command = sceneCommands[index % commandCount];
    if (uint(index / commandCount) >= complexities[index % commandCount]) command.instanceCount = 0u;
    layerCommands[index] = command;
}
