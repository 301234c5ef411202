// Light that a medium with an illumination network scatters to the eye: formula network-cell (4) and (5). Needs
// field/field_glow.glsl, network/network_grid.glsl, shared/scattered_light.glsl and formulas/network_cell.fx.h.
layout(binding = 3) uniform sampler3D networkMoments;

// Light that the network carries, all orders of all sources, per unit of extinction. block [texel]: of moments along x
vec3 networkScattered(int number, int block, vec3 p, vec3 toEye, vec3 albedo, float g)
{
    FieldGlow grid = glows[number];
    vec3 texel = clamp((p - grid.corner.xyz) / grid.corner.w, vec3(0.5), vec3(grid.cells.xyz) - 0.5);
    texel.z += float(grid.cells.w);
    vec3 perTexel = 1.0 / vec3(textureSize(networkMoments, 0));
    vec3 source;
    for (int c = 0; c < 3; ++c) {
        vec4 light = textureLod(networkMoments, (texel + vec3(block * c, 0.0, 0.0)) * perTexel, 0.0);
        source[c] = fxNetworkSource(albedo[c], clamp(g, -0.3, 0.98), light.x, dot(light.yzw, toEye.yzx));
    }
    return source;
}

// Share of extinction by which a beam is attenuated whose light goes straight on after it has met the peak: formula network-cell (5).
vec3 networkStraight(vec3 albedo, float g)
{
    return 1.0 - albedo * fxNetworkPeak(clamp(g, -0.3, 0.98));
}

// Adds the light of points that the network does not carry to a sum, before the albedo.
vec3 networkPointsOnce(vec3 sum, vec3 p, vec3 toEye, vec3 straight, float g, GlowBox box)
{
    for (int i = 1; i < lightCounts.x; ++i) {
        vec3 towards;
        vec3 arriving = pointLight(lights[i], p, towards) * shareOf(lights[i], box);
        sum += arriving * exp(-pointDepth(i, p).x * straight) * fxHenyeyGreenstein(-dot(towards, toEye), g);
    }
    return sum;
}

// Light of sun and points that the network does not carry: what has gone straight on.
vec3 networkScatteredOnce(vec3 p, vec3 toEye, vec3 albedo, float g, GlowBox box)
{
    vec3 straight = networkStraight(albedo, g);
    vec3 sun = lights[0].color.rgb * hostShadow(p) * exp(-sunDepth(p).x * straight) *
               fxHenyeyGreenstein(-dot(lights[0].place.xyz, toEye), g);
    return albedo * networkPointsOnce(sun, p, toEye, straight, g, box);
}

// What changes little within a ball of medium: the light of a network, and of points.
vec3 lightInNetwork(int network, int block, vec3 p, vec3 toEye, vec3 albedo, float g)
{
    GlowBox box = GlowBox(glows[network].corner.xyz, glows[network].corner.w * vec3(glows[network].cells.xyz), 0.0);
    return networkScattered(network, block, p, toEye, albedo, g) +
           albedo * networkPointsOnce(vec3(0.0), p, toEye, networkStraight(albedo, g), g, box);
}

// Number of the grid in which a place lies, of `count`; -1: none.
int networkAt(vec3 p, int count)
{
    int number = -1;
    for (int i = 0; i < count; ++i) {
        vec3 cell = (p - glows[i].corner.xyz) / glows[i].corner.w;
        bool isIn = all(greaterThanEqual(cell, vec3(0.0))) && all(lessThan(cell, vec3(glows[i].cells.xyz)));
        number = isIn && number < 0 ? i : number;
    }
    return number;
}
