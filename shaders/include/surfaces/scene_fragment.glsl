// SPDX-License-Identifier: MIT
// What include/surfaces/scene_vertex.glsl hands to fragments.
in vec3 positionVs;
in vec3 normalVs;
in vec2 uv;
flat in uint material;
