#include "field/field_blocks.glsl"
#include "field/field_glow.glsl"
#if FX_DETAIL
#include "field/field_detail.glsl"
#endif

// What the medium of each cell of the grids emits, extinguishes and scatters: the mean of the fields at some points of it, with
// their detail. FX_AGAIN 1 adds what the cell scatters of the light that it gets.
layout(local_size_x = 8, local_size_y = 4, local_size_z = 2) in;
layout(rgba32f, binding = 0) uniform image3D cells; // rgb emitted light [exposed/m]; a extinction [1/m]
#if FX_AGAIN
layout(binding = 3) uniform sampler3D glowScatter; // rgb [1/m] extinction times albedo; a mean cosine
layout(binding = 4) uniform sampler3D glowLight;   // rgb mean radiance [exposed]
#else
layout(binding = 12) uniform sampler2D brickTable;
layout(rgba16f, binding = 1) uniform writeonly image3D glowScatter;
layout(binding = 0) uniform sampler3D fieldMedium;
layout(binding = 1) uniform sampler3D fieldScatter;
#if FX_DETAIL
layout(binding = 2) uniform sampler3D fieldMaterial0;
layout(binding = 3) uniform sampler3D fieldMaterial1;
#endif
layout(std140, binding = 0) uniform GlowSourceBlock { ivec4 fieldCount; }; // x fields; y grids

const int kMaxPoints = 3; // along a side of a cell

// Adds a share of one field at a place. @param side [m] of the cube around it for which it stands
void addField(VoxelField field, vec3 p, float side, float share, inout vec4 medium, inout vec4 scatter)
{
    vec3 local = (p - field.corner.xyz) / field.corner.w;
    vec3 size = vec3(kBrickCells * field.bricks.xyz);
    bool isInside = all(greaterThanEqual(local, vec3(0.0))) && all(lessThan(local, size));
    ivec3 brick = clamp(ivec3(floor(local / float(kBrickCells))), ivec3(0), field.bricks.xyz - 1);
    float number = isInside ? abs(texelFetch(brickTable, tableTexel(tableEntry(field, brick)), 0).r) : 0.0;
    int turns = number > 0.0 ? 1 : 0;
    if (turns > 0) {
        vec3 texel = vec3(brickTexel(int(number) - 1)) + 0.5 + local - vec3(kBrickCells * brick);
        vec3 uv = texel / vec3(textureSize(fieldMedium, 0));
        vec4 own = textureLod(fieldMedium, uv, 0.0);
        float kept = own.a > 0.0 ? 1.0 : 0.0;
#if FX_DETAIL
        int detailed = field.limits.z > 0.5 && own.a > 0.0 ? 1 : 0;
        if (detailed > 0) {
            vec4 material0 = textureLod(fieldMaterial0, uv, 0.0);
            float perMedium = field.limits.y / own.a;
            vec4 material1 = perMedium * textureLod(fieldMaterial1, uv, 0.0);
            FieldDetail numbers = fieldDetail(int(field.limits.z));
            DetailPlace place = detailPlace(numbers.erosion, numbers.soft, own.a, material1.a);
            MediumDetail detail = detailOf(numbers, place, p, material0.rgb * perMedium, material1.rgb, kPixelOfCube * side,
                                           own.r + own.g + own.b > 0.0);
            kept = detail.share;
            own.rgb = detailedLight(own.rgb, detail, material0.a);
        }
#endif
        medium += share * kept * own;
        vec4 scattered = textureLod(fieldScatter, uv, 0.0);
        float all = scattered.r + scattered.g + scattered.b;
        scatter += share * kept * own.a * vec4(scattered.rgb, all * scattered.a);
    }
}
#endif

void main()
{
    ivec3 id = ivec3(gl_GlobalInvocationID);
#if FX_AGAIN
    vec4 medium = imageLoad(cells, id);
    medium.rgb += texelFetch(glowScatter, id, 0).rgb * texelFetch(glowLight, id, 0).rgb;
    imageStore(cells, id, medium);
#else
    int grid = glowOfLayer(id.z, fieldCount.y);
    FieldGlow glow = glows[grid];
    ivec3 place = id - ivec3(0, 0, glow.cells.w);
    if (any(greaterThanEqual(place, glow.cells.xyz)))
        return;
    vec3 cell = vec3(place);
    vec4 medium = vec4(0.0);
    vec4 scatter = vec4(0.0); // a cosine times the sum of rgb
    for (int f = 0; f < fieldCount.x; ++f) {
        VoxelField field = fieldOf(f);
        bool isOfGrid = int(field.limits.w) == grid + 1;
        int points = isOfGrid ? clamp(int(ceil(glow.corner.w / field.corner.w)), 1, kMaxPoints) : 0;
        float share = 1.0 / float(max(points * points * points, 1));
        for (int i = 0; i < points * points * points; ++i) {
            vec3 part = (vec3(i % points, i / points % points, i / (points * points)) + 0.5) / float(points);
            addField(field, glow.corner.xyz + glow.corner.w * (cell + part), glow.corner.w / float(points), share, medium,
                     scatter);
        }
    }
    imageStore(cells, id, max(medium, vec4(0.0)));
    vec3 scattered = max(scatter.rgb, vec3(0.0));
    imageStore(glowScatter, id, vec4(scattered, scatter.a / max(scattered.r + scattered.g + scattered.b, 1e-20)));
#endif
}
