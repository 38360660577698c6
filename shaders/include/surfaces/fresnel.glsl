// SPDX-License-Identifier: MIT
// A smooth dielectric interface: directions and exact unpolarised reflectance, well-behaved at
// grazing incidence and just below the critical angle (hard cases 19 to 24).

struct Interface {
    float reflectance;     // 1 for total internal reflection
    vec3 reflected;        // unit
    vec3 refracted;        // unit; zero for total internal reflection
};

// `direction`: unit, towards the surface; `normal`: unit, either side; the light comes from a
// medium of index `from` and would go on in one of index `to`.
Interface interactAt(vec3 direction, vec3 normal, float from, float to) {
    vec3 n = dot(direction, normal) < 0.0 ? normal : -normal;
    // 1 - (eta sin)^2 loses all its digits near the critical angle in 32 bits.
    double eta = double(from) / double(to);
    dvec3 d = dvec3(direction);
    dvec3 m = dvec3(n);
    double lengths = dot(d, d) * dot(m, m);
    double cosine = -dot(d, m);
    double cosine2 = cosine * cosine / lengths;
    dvec3 tangent = cross(d, m);
    double sine2 = dot(tangent, tangent) / lengths;
    double transmitted2 = 1.0LF - eta * eta * sine2;

    Interface result;
    float cosI = float(sqrt(cosine2));
    result.reflected = normalize(direction + 2.0 * cosI * n);
    if (transmitted2 <= 0.0LF) {
        result.reflectance = 1.0;
        result.refracted = vec3(0.0);
        return result;
    }
    float cosT = float(sqrt(transmitted2));
    float ratio = float(eta);
    result.refracted = normalize(ratio * direction + (ratio * cosI - cosT) * n);
    // Both denominators are positive unless both cosines are 0, where the reflectance is 1.
    float sDenominator = ratio * cosI + cosT;
    float pDenominator = cosI + ratio * cosT;
    if (sDenominator <= 0.0 || pDenominator <= 0.0) {
        result.reflectance = 1.0;
        return result;
    }
    float s = (ratio * cosI - cosT) / sDenominator;
    float p = (cosI - ratio * cosT) / pDenominator;
    result.reflectance = clamp(0.5 * (s * s + p * p), 0.0, 1.0);
    return result;
}
