// Reads a particle at the moment of the frame. Needs shared/particle_block.glsl and shared/view_block.glsl.
// Column numbers are those of foundation/snapshot/particle_kind.h.
layout(std430, binding = 0) readonly buffer NewerRows { float newerWords[]; };
layout(std430, binding = 1) readonly buffer OlderRows { float olderWords[]; };
layout(std430, binding = 2) readonly buffer DrawOrder { uint drawOrder[]; };

int newerPlace(int column) { return newerAt[column >> 2][column & 3]; }
int olderPlace(int column) { return olderAt[column >> 2][column & 3]; }
float newerValue(int column, int row) { return newerWords[newerPlace(column) + row]; }
float olderValue(int column, int row) { return olderWords[olderPlace(column) + row]; }
vec3 newerVector(int c, int row) { return vec3(newerValue(c, row), newerValue(c + 1, row), newerValue(c + 2, row)); }
vec3 olderVector(int c, int row) { return vec3(olderValue(c, row), olderValue(c + 1, row), olderValue(c + 2, row)); }

vec4 colorOfWords(float low, float high)
{
    return vec4(unpackHalf2x16(floatBitsToUint(low)), unpackHalf2x16(floatBitsToUint(high)));
}
vec4 newerColor(int column, int row)
{
    int at = newerPlace(column) + 2 * row;
    return colorOfWords(newerWords[at], newerWords[at + 1]);
}
vec4 olderColor(int column, int row)
{
    int at = olderPlace(column) + 2 * row;
    return colorOfWords(olderWords[at], olderWords[at + 1]);
}

// The row that is drawn as number `rank`.
int rowOfRank(int rank)
{
    if (strip.z > 1.5)
        return int(drawOrder[2 * rank]);
    return strip.z > 0.5 ? int(drawOrder[rank]) : rank;
}

// What the level of detail makes of it: factors of its size and of its opacity.
vec2 lookOfRank(int rank) { return strip.z > 1.5 ? unpackHalf2x16(drawOrder[2 * rank + 1]) : vec2(1.0); }
float opacityOf(float opacity, vec2 levelLook)
{
    bool covers = look.w < 0.5; // and cannot do so more than wholly
    return levelLook.y == 1.0 ? opacity : covers ? min(opacity * levelLook.y, 1.0) : opacity * levelLook.y;
}

vec3 rotated(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

// From the group's axes to the world's, relative to the eye.
vec3 placed(vec3 local) { return placePosition.xyz + rotated(placeRotation, local * placePosition.w); }
vec3 placedDirection(vec3 local) { return rotated(placeRotation, local * placePosition.w); }

struct Particle
{
    bool alive;
    vec3 center;   // [m] relative to the eye
    vec3 velocity; // [m/s]
    float radius;  // [m]
    vec4 color;
    float angle;   // [rad]
    float frame;
    vec4 orientation;
};

// A row that lives in both snapshots is mixed of both; one that was born between them is carried back along its velocity.
Particle fetchParticle(int row)
{
    Particle p;
    float age = newerValue(3, row);
    float back = (1.0 - moment.x) * moment.y;
    bool both = moment.z > 0.5 && row < rows.y && age >= moment.y;
    if (both) {
        float before = olderValue(3, row);
        both = olderValue(4, row) > 0.0 && abs(before + moment.y - age) < 0.5 * moment.y;
    }
    float t = both ? moment.x : 1.0;
    vec3 position = newerVector(0, row);
    p.radius = newerValue(4, row);
    p.color = newerColor(5, row);
    p.alive = p.radius > 0.0 && (both || moment.z < 0.5 || age >= back);
    vec3 velocity = newerPlace(6) >= 0 ? newerVector(6, row) : vec3(0.0);
    p.angle = newerPlace(9) >= 0 ? newerValue(9, row) : 0.0;
    p.frame = newerPlace(10) >= 0 ? newerValue(10, row) : 0.0;
    p.orientation = vec4(0.0, 0.0, 0.0, 1.0);
    if (newerPlace(11) >= 0)
        p.orientation = vec4(newerVector(11, row), newerValue(14, row));
    if (both) {
        position = mix(olderVector(0, row), position, t);
        p.radius = mix(olderValue(4, row), p.radius, t);
        if (newerPlace(6) >= 0 && olderPlace(6) >= 0)
            velocity = mix(olderVector(6, row), velocity, t);
        p.color = mix(olderColor(5, row), p.color, t);
        if (olderPlace(9) >= 0)
            p.angle = mix(olderValue(9, row), p.angle, t);
        if (olderPlace(10) >= 0 && olderValue(10, row) <= p.frame) // otherwise it began anew
            p.frame = mix(olderValue(10, row), p.frame, t);
        if (olderPlace(11) >= 0 && newerPlace(11) >= 0) {
            vec4 before = vec4(olderVector(11, row), olderValue(14, row));
            p.orientation = normalize(mix(dot(before, p.orientation) < 0.0 ? -before : before, p.orientation, t));
        }
    } else if (moment.z > 0.5) {
        position -= velocity * back;
    }
    p.center = placed(position);
    p.velocity = placedDirection(velocity);
    p.radius *= placePosition.w;
    return p;
}
