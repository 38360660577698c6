// SPDX-License-Identifier: MIT
// The mean over a frame's samples so far (eye.samples), and what the last one has in its place.
layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) uniform image2D meanOfSamples;
layout(rgba32f) writeonly uniform image2D meanSoFar;
uniform sampler2D ofSample;
uniform int sampleNumber;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(meanOfSamples)))) return;
    vec4 mean = texelFetch(ofSample, pixel, 0);
    if (sampleNumber > 0) {
        vec4 before = imageLoad(meanOfSamples, pixel);
        mean = before + (mean - before) / float(sampleNumber + 1);
    }
    imageStore(meanOfSamples, pixel, mean);
    imageStore(meanSoFar, pixel, mean);
}
