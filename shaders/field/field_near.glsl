// Balls near the eye of a field with detail. They are not in its samples; what they have at a place is added there. Layout of
// rendering/field/field_texels.cpp. Needs field/field_blocks.glsl and formulas/kernel_optical_depth.fx.h.
const int kNearTexels = 4;

struct NearMedium
{
    vec4 medium;   // rgb emitted light [exposed/m]; a extinction [1/m]
    vec4 carried0; // xyz [cell] mean coordinates of the first generation; w mean thinning
    vec4 carried1; // xyz of the second; w mean power of temperature by which emitted light follows the detail
};

// @param soft of FieldDetail
NearMedium nearMedium(vec3 p, vec4 soft)
{
    NearMedium sum;
    sum.medium = sum.carried0 = sum.carried1 = vec4(0.0);
    for (int i = 0; i < int(soft.z); ++i) {
        int first = int(soft.y) + kNearTexels * i;
        vec4 place = fieldTexel(first), sent = fieldTexel(first + 1);
        vec3 d = p - place.xyz;
        float extinction = fxKernelExtinction(sent.a, place.w, dot(d, d));
        sum.medium += extinction * vec4(sent.rgb, 1.0);
        if (extinction > 0.0) {
            sum.carried0 += extinction * fieldTexel(first + 2);
            sum.carried1 += extinction * fieldTexel(first + 3);
        }
    }
    float perExtinction = 1.0 / max(sum.medium.a, 1e-20);
    sum.carried0 *= perExtinction;
    sum.carried1 *= perExtinction;
    return sum;
}
