#include "shared/particle_block.glsl"
#include "shared/view_block.glsl"
#include "shared/particle_fetch.glsl"
#include "shared/particle_place.glsl"
#include "shared/particle_light.glsl"

// One piece of a strip between two rows that follow each other; pieces of one strip share their corners.
out vec3 fragmentPlace;
out vec2 fragmentTexture;     // x across, 0 to 1; y [m] along, in lengths of the texture
out vec4 fragmentColor;
#ifdef FX_MARKS
out vec3 fragmentVelocity; // [m/s] relative to the world
#endif

// Columns of the kind: x y z halfWidth arc color strip age. The strip is not there: a color whose opacity has a sign goes on
// with the strip of the row before.
vec3 pointAt(int row) { return placed(newerVector(0, row)); }
bool goesOn(int row)
{
    return row > 0 && row < rows.x && floatBitsToUint(newerWords[newerPlace(5) + 2 * row + 1]) >> 31 != 0u;
}
vec4 colorAt(int row) { return abs(newerColor(5, row)); }

// Unit vector across the strip at a row, as far as it can facing the eye.
vec3 acrossAt(int row)
{
    vec3 here = pointAt(row);
    vec3 along = (goesOn(row) ? pointAt(row - 1) : here) - (goesOn(row + 1) ? pointAt(row + 1) : here);
    vec3 across = cross(lookAt(here), along);
    float size = length(across);
    return size > 1e-6 * length(along) ? across / size : right.xyz;
}

void main()
{
    int rank = rankOfQuad(gl_InstanceID, gl_VertexID);
    int vertex = gl_VertexID % kQuadVertices;
    int row = rowOfRank(rank);
    vec2 levelFactors = factorsOfRank(rank);
    fragmentPlace = vec3(0.0);
    fragmentTexture = vec2(0.0);
    fragmentColor = vec4(0.0);
#ifdef FX_MARKS
    fragmentVelocity = driftAt(vec4(newerVector(0, row), 1.0)); // points of a trail rest where they were left
#endif
    gl_Position = clippedAway();
    if (!goesOn(row + 1) || levelFactors.x == 0.0)
        return;
    bool isSecond = vertex == 2 || vertex == 4 || vertex == 5;
    float side = vertex == 1 || vertex == 2 || vertex == 4 ? 1.0 : -1.0;
    int at = isSecond ? row + 1 : row;
    // The way that lies after the moment of the frame is not seen yet: the piece in which the moment lies ends there.
    float later = 0.0;
    float back = moment.z > 0.5 ? (1.0 - moment.x) * moment.y : 0.0;
    if (back > 0.0 && newerPlace(7) >= 0) {
        float young = newerValue(7, row);
        float old = newerValue(7, row + 1);
        if (old <= back)
            return;
        if (!isSecond && young < back)
            later = (back - young) / (old - young);
    }
    // Rows go on behind the age at which the ribbon ends; at an earlier moment that age lay farther back.
    int from = at;
    if (appearance.x > 0.0 && newerPlace(7) >= 0) {
        float young = newerValue(7, row);
        float old = newerValue(7, row + 1);
        if (young >= appearance.x + back)
            return;
        if (isSecond && old > appearance.x + back) {
            from = row;
            later = (appearance.x + back - young) / (old - young);
        }
    }
    vec3 center = mix(pointAt(from), pointAt(row + 1), later);
    float halfWidth = mix(newerValue(3, from), newerValue(3, row + 1), later) * placePosition.w * levelFactors.x;
    float shown = max(halfWidth, moment.w * pixelSize(center));
    vec4 color = mix(colorAt(from), colorAt(row + 1), later);
    vec3 across = acrossAt(at) * (side * shown);
    fragmentPlace = center + across;
    float arc = mix(newerValue(4, from), newerValue(4, row + 1), later);
    fragmentTexture = vec2(0.5 + 0.5 * side, strip.y > 0.0 ? arc / strip.y : arc);
    vec3 light = shine.x * color.rgb;
    if (shine.y > 0.0)
        light += scatteredByCard(center, across, shown, color);
    fragmentColor = vec4(light, opacityOf(color.a * halfWidth / max(shown, 1e-30), levelFactors));
    gl_Position = clipOf(fragmentPlace);
}
