// What one fragment of a blob's rectangle sees. Needs shared/view_block.glsl, shared/blob_chord.glsl and the
// formulas it calls.
// FX_FORM: 0 planar card, 1 homogeneous ball, 2 quartic kernel. FX_SMALL: 1 for layers smaller than the picture.

flat in vec4 blobCenterRadius;
flat in vec4 blobMedium;

struct BlobRay
{
    float opticalDepth; // [1] without detail
    vec3 toPoint;       // [m] from the blob's center to the point whose light stands for the whole path
    vec3 toDetail;      // [m] likewise of the path through all depths, so that ranges of depth have the same detail
    float distance;     // [m] of that point from the ray's origin
    vec3 direction;     // unit
    vec3 across;        // [m] from the blob's center to the nearest point of the ray
    float halfChord;    // [m]
    float front, back;  // [m] where the visible part of the chord begins and ends, from its middle
};

BlobRay traceBlob()
{
    BlobChord chord = chordOf(blobCenterRadius.xyz);
#if FX_SMALL
    if (chord.t1 <= chord.t0)
        discard; // small layers have many texels of which nothing is seen
#endif
    float radius = blobCenterRadius.w;
    float h = chord.h;
    float tc = chord.tc;
    float t0 = chord.t0;
    float t1 = chord.t1;

    BlobRay result;
#if FX_FORM == 0
    float middle = tc > t0 && tc < t1 ? 1.0 : 0.0; // a card has no thickness: it is seen whole or not at all
    result.opticalDepth = middle * fxKernelOpticalDepth(blobMedium.x, radius, h, 0.0, -radius, radius);
#elif FX_FORM == 1
    result.opticalDepth = fxUniformBallOpticalDepth(blobMedium.x, radius, h, tc, t0, t1);
#else
    result.opticalDepth = fxKernelOpticalDepth(blobMedium.x, radius, h, tc, t0, t1);
#endif
    float w = sqrt(max((radius - h) * (radius + h), 0.0));
    float front = max(t0, tc - w);
    float back = max(min(t1, tc + w), front);
    float depthOfView = 0.5 / (1.0 + 0.5 * result.opticalDepth); // thin: the middle; thick: near the front
    result.distance = mix(front, back, depthOfView);
    result.toPoint = chord.origin + chord.direction * result.distance - blobCenterRadius.xyz;
    result.toDetail = result.toPoint;
    bool isCut = t0 > chord.open.x || t1 < chord.open.y;
    for (int i = 0; i < (isCut ? 1 : 0); ++i) { // software renderers skip a loop without turns
        float depth = fxKernelOpticalDepth(blobMedium.x, radius, h, tc, chord.open.x, chord.open.y);
#if FX_FORM == 0
        depth = result.opticalDepth;
#elif FX_FORM == 1
        depth = fxUniformBallOpticalDepth(blobMedium.x, radius, h, tc, chord.open.x, chord.open.y);
#endif
        float first = max(chord.open.x, tc - w);
        float last = max(min(chord.open.y, tc + w), first);
        result.toDetail = chord.origin + chord.direction * mix(first, last, 0.5 / (1.0 + 0.5 * depth)) - blobCenterRadius.xyz;
    }
    result.direction = chord.direction;
    result.across = chord.across;
    result.halfChord = w;
    result.front = front - tc;
    result.back = back - tc;
    return result;
}
