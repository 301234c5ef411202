// Where the ray of one fragment passes a blob. Needs shared/view_block.glsl.
layout(binding = 0) uniform sampler2D sceneDistance; // [m] along the ray to the opaque surface, +inf for none

struct BlobChord
{
    vec3 origin;    // [m] of the ray, relative to the eye
    vec3 direction; // unit
    vec3 across;    // [m] from the center to the nearest point of the ray
    float h;        // [m] length of `across`
    float tc;       // [m] ray parameter of that point
    float t0, t1;   // [m] where the part of the ray that is drawn begins and ends
    vec2 open;      // [m] where the visible ray begins and ends, of all depths
};

BlobChord chordOf(vec3 center)
{
    BlobChord chord;
    float lengthPerDepth;
    viewRay(gl_FragCoord.xy, chord.origin, chord.direction, lengthPerDepth);
    vec3 toCenter = center - chord.origin;
    chord.tc = dot(toCenter, chord.direction);
    chord.across = chord.tc * chord.direction - toCenter; // perpendicular: keeps the digits that b^2 - c^2 would lose
    chord.h = length(chord.across);
    chord.open = vec2(rayOriginX.w * lengthPerDepth, texelFetch(sceneDistance, ivec2(gl_FragCoord.xy), 0).r);
    vec2 part = drawnPart(chord.open, lengthPerDepth);
    chord.t0 = part.x;
    chord.t1 = part.y;
    return chord;
}
