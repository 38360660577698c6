// SPDX-License-Identifier: MIT
// One direction of a Gaussian, cut off at 3 sigma and normalised over its samples. Beyond the
// border the picture goes on as its mirror image, however small it is: what each pixel gives away
// adds up to 1 then, as what each takes does.
layout(location = 0) out vec4 blurred;

uniform sampler2D source;
uniform float sigma;  // px
uniform int reach;    // px
uniform ivec2 along;

int mirrored(int i, int size) {
    i = (i < 0 ? -1 - i : i) % (2 * size);  // of a negative number % is undefined
    return i < size ? i : 2 * size - 1 - i;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 size = textureSize(source, 0);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int k = -reach; k <= reach; ++k) {
        float x = float(k) / sigma;
        float weight = exp(-0.5 * x * x);
        ivec2 at = pixel + k * along;
        at = ivec2(mirrored(at.x, size.x), mirrored(at.y, size.y));
        sum += weight * texelFetch(source, at, 0);
        weights += weight;
    }
    blurred = sum / weights;
}
