#include "stage/stage_block.glsl"
#include "stage/soil_surface.glsl"

// Diffuse surfaces under the sun with soft-edged shadows, the sky, and the light of the effects.
layout(binding = 0) uniform sampler2D shadowMap;
layout(binding = 1) uniform sampler2D mediaPlanes;

in vec3 worldPosition;
in vec3 worldNormal;
in vec3 albedo;
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

vec3 stageLightAt(StageLight light, vec3 n)
{
    vec3 toLight = light.position.xyz - worldPosition;
    float l2 = dot(toLight, toLight);
    float d2 = l2 + light.position.w * light.position.w;
    float facing = mix(dot(n, toLight) * inversesqrt(d2), 1.0, light.traits.x); // a fireball is wide: its light wraps
    float share = clamp(light.cone.w - dot(toLight, light.cone.xyz) * inversesqrt(max(l2, 1e-12)), 0.0, 1.0);
    vec3 arriving = light.intensity.rgb * (max(facing, 0.0) * share * share * (3.0 - 2.0 * share) / d2);
    if (light.traits.y > 0.5 && arriving.r + arriving.g + arriving.b > 0.0)
        arriving *= fxMediaTransmittance(mediaPlanes, mediaShadows[int(light.traits.y)], worldPosition);
    return arriving;
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
    float cosine = max(dot(n, sunDirection.xyz), 0.0);
    vec3 illuminance = vec3(0.0);
    if (cosine > 0.0)
        illuminance += sunLight.rgb * cosine * sunVisibility(n, min(cosine, 1.0)) *
                       fxMediaTransmittance(mediaPlanes, mediaShadows[0], worldPosition);
    vec3 fromGround = skyLight.w * (sunLight.rgb * max(sunDirection.y, 0.0) * kInvPi + skyLight.rgb);
    illuminance += 3.14159265 * mix(fromGround, skyLight.rgb, 0.5 + 0.5 * n.y);
    for (int i = 0; i < int(sunLight.w); ++i)
        illuminance += stageLightAt(stageLights[i], n);
    color = vec4(reflectance * kInvPi * illuminance, 1.0);
}
