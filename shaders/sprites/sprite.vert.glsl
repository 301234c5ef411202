#include "shared/particle_block.glsl"
#include "shared/view_block.glsl"
#include "shared/particle_fetch.glsl"
#include "shared/particle_place.glsl"
#include "shared/particle_light.glsl"

// One square a particle.
out vec3 fragmentPlace;      // [m] relative to the eye
out vec2 fragmentTexture;    // [0, 1] from the lower left of the frame
flat out vec4 fragmentColor; // rgb exposed light that a white texel emits; a opacity
out vec3 fragmentScattered;  // exposed light that it scatters
flat out float fragmentFrame;
#ifdef FX_MARKS
out vec3 fragmentVelocity; // [m/s] relative to the world
#endif

// Vertical and horizontal of the square, unit. Returns whether the vertical lies along the velocity, before it is turned.
bool standUp(Particle p, out vec3 horizontal, out vec3 vertical)
{
    bool isAlong = false;
    vec3 look0 = lookAt(p.center);
    horizontal = normalize(cross(look0, up.xyz));
    vertical = cross(horizontal, look0);
    int alignment = int(alignAxis.w);
    if (alignment == 3) {
        vec3 n = alignAxis.xyz;
        horizontal = normalize(cross(abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), n));
        vertical = cross(n, horizontal);
    } else if (alignment > 0) {
        vec3 along = alignment == 1 ? p.velocity : alignAxis.xyz;
        vec3 across = cross(look0, along);
        float size = length(along);
        if (length(across) > 1e-4 * size && size > 0.0) {
            horizontal = normalize(across);
            vertical = along / size;
            isAlong = alignment == 1;
        }
    }
    float c = cos(p.angle);
    float s = sin(p.angle);
    vec3 turned = c * horizontal + s * vertical;
    vertical = c * vertical - s * horizontal;
    horizontal = turned;
    return isAlong;
}

// A rectangle of `area` times the area: its short side grows first, so that streaks become wider before they become longer.
vec2 grown(vec2 extent, float area)
{
    float least = max(min(extent.x, extent.y), 1e-30);
    float narrow = max(min(area, max(extent.x, extent.y) / least), 1.0);
    vec2 both = extent * sqrt(area / narrow);
    return extent.x < extent.y ? vec2(both.x * narrow, both.y) : vec2(both.x, both.y * narrow);
}

void main()
{
    int rank = rankOfQuad(gl_InstanceID, gl_VertexID);
    int vertex = gl_VertexID % kQuadVertices;
    Particle p = fetchParticle(rowOfRank(rank));
    fragmentPlace = vec3(0.0);
    fragmentTexture = vec2(0.0);
    fragmentColor = vec4(0.0);
    fragmentScattered = vec3(0.0);
    fragmentFrame = p.frame;
#ifdef FX_MARKS
    fragmentVelocity = p.drift;
#endif
    gl_Position = clippedAway();
    vec2 levelFactors = factorsOfRank(rank);
    if (!p.alive || levelFactors.x == 0.0)
        return;
    vec3 horizontal;
    vec3 vertical;
    bool isAlong = standUp(p, horizontal, vertical); // seen from its end a streak has no length
    vec2 extent = vec2(p.radius * appearance.x, p.radius);
    if (isAlong)
        extent.y += 0.5 * appearance.y * length(p.velocity);
    extent = grown(extent, levelFactors.x * levelFactors.x);
    float least = moment.w * pixelSize(p.center);
    vec2 shown = max(extent, vec2(least)); // what is smaller than a pixel is widened to it and thinned as much
    float thinned = extent.x * extent.y / max(shown.x * shown.y, 1e-30);
    vec2 corner = vec2(vertex == 1 || vertex == 2 || vertex == 4 ? 1.0 : -1.0,
                       vertex == 2 || vertex == 4 || vertex == 5 ? 1.0 : -1.0);
    vec3 across = horizontal * (corner.x * shown.x) + vertical * (corner.y * shown.y);
    fragmentPlace = p.center + across;
    fragmentTexture = 0.5 + 0.5 * corner;
    if (shine.y > 0.0)
        fragmentScattered = scatteredByCard(p.center, across, sqrt(shown.x * shown.y), p.color);
    fragmentColor = vec4(p.color.rgb * shine.x, opacityOf(p.color.a * thinned, levelFactors));
    gl_Position = clipOf(fragmentPlace);
}
