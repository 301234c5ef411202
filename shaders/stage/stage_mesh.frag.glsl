#include "stage/stage_block.glsl"
#include "stage/soil_surface.glsl"
#include "stage/water_surface.glsl"

// Diffuse surfaces and water under the sun with soft-edged shadows, the sky, and the light of the effects.
layout(binding = 0) uniform sampler2D shadowMap;
layout(binding = 1) uniform sampler2D mediaPlanes;

in vec3 worldPosition;
in vec3 worldNormal;
in vec3 albedo;
flat in float isWater;
layout(location = 0) out vec4 color;

const float kInvPi = 0.318309886;

// The point is lifted off its surface by what the filter reaches over a slanted one, so that nothing shades itself.
float sunVisibility(vec3 n, float cosine)
{
    float lift = rayDirection.w * (1.0 + 3.0 * sqrt(1.0 - cosine * cosine));
    vec4 clip = shadowFromMesh * vec4(worldPosition - meshOffset.xyz + n * lift, 1.0);
    vec2 uv = clip.xy * 0.5 + 0.5;
    float depth = min(clip.z * 0.5 + 0.5, 1.0); // the map has 1 where nothing casts a shadow
    float lit = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            lit += texture(shadowMap, uv + vec2(x, y) * sunDirection.w).r + 0.0003 >= depth ? 1.0 : 0.0;
    return lit / 9.0;
}

// Light that arrives, through a surface across it.
vec3 arrivingAt(StageLight light, vec3 toLight, float l2, float d2)
{
    float share = clamp(light.cone.w - dot(toLight, light.cone.xyz) * inversesqrt(max(l2, 1e-12)), 0.0, 1.0);
    vec3 arriving = light.intensity.rgb * (share * share * (3.0 - 2.0 * share) / d2);
    if (light.traits.y > 0.5 && arriving.r + arriving.g + arriving.b > 0.0)
        arriving *= fxMediaTransmittance(mediaPlanes, mediaShadows[int(light.traits.y)], worldPosition);
    return arriving;
}

vec3 stageLightAt(StageLight light, vec3 n)
{
    vec3 toLight = light.position.xyz - worldPosition;
    float l2 = dot(toLight, toLight);
    float d2 = l2 + light.position.w * light.position.w;
    float facing = mix(dot(n, toLight) * inversesqrt(d2), 1.0, light.traits.x); // a fireball is wide: its light wraps
    return facing > 0.0 ? arrivingAt(light, toLight, l2, d2) * facing : vec3(0.0);
}

// What water mirrors towards the eye, and the share of the light that is left for its depth.
vec3 mirrored(WaterSurface surface, vec3 sun, out float outRest)
{
    vec3 v = -normalize(worldPosition);
    vec3 n = surface.normal;
    float facing = max(dot(n, v), 0.02);
    float reflectance = waterReflectance(facing);
    vec3 r = reflect(-v, n);
    vec3 sum = reflectance * skyAt(normalize(vec3(r.x, max(r.y, 0.004), r.z)), nearTrees.w + 2.0 * surface.roughness);
    sum += sun * waterGlint(n, v, sunDirection.xyz, surface.roughness, 0.0047);
    for (int i = 0; i < int(sunLight.w); ++i) {
        vec3 toLight = stageLights[i].position.xyz - worldPosition;
        float l2 = dot(toLight, toLight);
        float d2 = l2 + stageLights[i].position.w * stageLights[i].position.w;
        vec3 l = toLight * inversesqrt(max(l2, 1e-12));
        sum += arrivingAt(stageLights[i], toLight, l2, d2) *
               waterGlint(n, v, l, surface.roughness, stageLights[i].position.w * inversesqrt(d2));
    }
    outRest = 1.0 - reflectance;
    return sum;
}

void main()
{
    vec3 n = normalize(worldNormal);
    vec3 reflectance = albedo;
    vec2 place = worldPosition.xz - meshOffset.xz;
    vec2 across = dFdx(place);
    vec2 along = dFdy(place);
    // Soil is level and at the height of the mesh's origin; figures and props stand on it.
    if (horizon.w > 0.5 && worldNormal.y > 0.999 && abs(worldPosition.y - meshOffset.y) < 0.01) {
        bool isSwapped = dot(across, across) > dot(along, along);
        SoilSurface soil = soilAt(place, isSwapped ? across : along, length(isSwapped ? along : across));
        n = normalize(n - vec3(soil.slope.x, 0.0, soil.slope.y));
        reflectance *= soil.share;
    }
    WaterSurface surface = WaterSurface(n, 0.005);
    if (isWater > 0.5 && worldNormal.y > 0.999) {
        surface = wavesAt(place, max(length(across), length(along)));
        n = surface.normal;
    }
    float cosine = max(dot(n, sunDirection.xyz), 0.0);
    vec3 sun = vec3(0.0);
    if (cosine > 0.0)
        sun = sunLight.rgb * (sunVisibility(n, min(cosine, 1.0)) *
                              fxMediaTransmittance(mediaPlanes, mediaShadows[0], worldPosition));
    vec3 illuminance = sun * cosine;
    vec3 fromGround = skyLight.w * (sunLight.rgb * max(sunDirection.y, 0.0) * kInvPi + skyLight.rgb);
    illuminance += 3.14159265 * mix(fromGround, skyLight.rgb, 0.5 + 0.5 * n.y);
    for (int i = 0; i < int(sunLight.w); ++i)
        illuminance += stageLightAt(stageLights[i], n);
    float rest = 1.0;
    vec3 mirror = vec3(0.0);
    if (isWater > 0.5)
        mirror = mirrored(surface, sun, rest);
    color = vec4(reflectance * (rest * kInvPi) * illuminance + mirror, 1.0);
}
