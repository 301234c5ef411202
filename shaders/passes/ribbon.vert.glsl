#include "shared/particle_block.glsl"
#include "shared/view_block.glsl"
#include "shared/particle_fetch.glsl"
#include "shared/particle_place.glsl"

// One piece of a strip between two rows that follow each other; pieces of one strip share their corners.
out vec3 fragmentPlace;
out vec2 fragmentTexture;     // x across, 0 to 1; y [m] along, in lengths of the texture
out vec4 fragmentColor;

// Columns of the kind: x y z halfWidth arc color strip.
vec3 pointAt(int row) { return placed(newerVector(0, row)); }
bool sameStrip(int a, int b)
{
    if (a < 0 || b >= rows.x)
        return false;
    int at = newerPlace(6);
    return floatBitsToUint(newerWords[at + 2 * a]) == floatBitsToUint(newerWords[at + 2 * b]) &&
           floatBitsToUint(newerWords[at + 2 * a + 1]) == floatBitsToUint(newerWords[at + 2 * b + 1]);
}

// Unit vector across the strip at a row, as far as it can facing the eye.
vec3 acrossAt(int row)
{
    vec3 here = pointAt(row);
    vec3 along = (sameStrip(row - 1, row) ? pointAt(row - 1) : here) - (sameStrip(row, row + 1) ? pointAt(row + 1) : here);
    vec3 across = cross(lookAt(here), along);
    float size = length(across);
    return size > 1e-6 * length(along) ? across / size : right.xyz;
}

void main()
{
    int row = rows.z + gl_InstanceID;
    fragmentPlace = vec3(0.0);
    fragmentTexture = vec2(0.0);
    fragmentColor = vec4(0.0);
    gl_Position = clippedAway();
    if (!sameStrip(row, row + 1))
        return;
    bool isSecond = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
    float side = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4 ? 1.0 : -1.0;
    int at = isSecond ? row + 1 : row;
    vec3 center = pointAt(at);
    float halfWidth = newerValue(3, at) * placePosition.w;
    float shown = max(halfWidth, moment.w * pixelSize(center));
    vec4 color = newerColor(5, at);
    fragmentPlace = center + acrossAt(at) * (side * shown);
    fragmentTexture = vec2(0.5 + 0.5 * side, newerValue(4, at) / max(strip.y, 1e-6));
    vec3 white = vec3(shine.x);
    if (shine.y > 0.0)
        white += shine.y * scatteredByBall(center);
    fragmentColor = vec4(color.rgb * white, color.a * halfWidth / max(shown, 1e-30));
    gl_Position = clipOf(fragmentPlace);
}
