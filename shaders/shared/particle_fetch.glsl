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

// Rank of the particle or of the ribbon's piece that a vertex belongs to. Quads are drawn in one instance where their number
// is known to the processor: an instance of 6 vertices would leave most lanes of the hardware idle.
const int kQuadVertices = 6;
int rankOfQuad(int instance, int vertex)
{
    return rows.z + instance + vertex / kQuadVertices;
}

// The row that is drawn as number `rank`; strip.z is an OrderForm of rendering/particle_rows/particle_frame.h.
int rowOfRank(int rank)
{
    int form = int(strip.z);
    if (form == 2)
        return int(drawOrder[2 * rank]);
    return form == 1 ? int(drawOrder[rank]) : rank;
}

// What the level of detail makes of it: factors of its size and of its opacity; 0: it is not drawn.
vec2 factorsOfRank(int rank)
{
    int form = int(strip.z);
    if (form == 2)
        return unpackHalf2x16(drawOrder[2 * rank + 1]);
    return form == 3 ? unpackHalf2x16(drawOrder[rank]) : vec2(1.0);
}
float opacityOf(float opacity, vec2 levelFactors)
{
    bool covers = appearance.w < 0.5; // and cannot do so more than wholly
    return levelFactors.y == 1.0 ? opacity : covers ? min(opacity * levelFactors.y, 1.0) : opacity * levelFactors.y;
}

vec3 rotated(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

#ifdef FX_MARKS
// Velocity of a point that rests in the group's axes; with w 0, of a way in them.
vec3 driftAt(vec4 local) { return vec3(dot(drift[0], local), dot(drift[1], local), dot(drift[2], local)); }
#endif

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
#ifdef FX_MARKS
    vec3 drift;     // [m/s] of the center, relative to the world
    vec2 turned;    // [rad] angles in the older and the newer snapshot
    vec4 oriented[2]; // orientations, likewise
#endif
};

// Rows of the CPU are packed, as rendering/particle_rows/packed_rows.h says.
const float kAgeUnit = 1.0 / 2048.0; // [s]
const float kMaxAge = 2047.0 / 2048.0;
const float kTurnUnit = 6.28318531 / 4096.0; // [rad]
bool newerIsPacked() { return newerPlace(15) >= 0; }
bool olderIsPacked() { return moment.z > 0.5 && olderPlace(15) >= 0; }
uint newerBits(int column, int row) { return floatBitsToUint(newerValue(column, row)); }
uint olderBits(int column, int row) { return floatBitsToUint(olderValue(column, row)); }

float radiusOfBits(uint sizes)
{
    uint code = sizes & 0x1FFFFu;
    return code == 0u ? 0.0 : uintBitsToFloat((code << 12) + (87u << 23));
}
float powerOfTwo(int e) { return uintBitsToFloat(uint(e + 127) << 23); }
float ageOfBits(uint high) { return float(high >> 21) * kAgeUnit; }
vec4 colorOfBits(uint sizes, uint low, uint high)
{
    vec3 parts = vec3(uvec3(low, low >> 12, low >> 24 | high << 8) & 0xFFFu);
    return vec4(parts * powerOfTwo(int(high >> 4 & 31u) - 27), unpackHalf2x16(sizes >> 17).x);
}
vec3 velocityOfBits(uint bits, uint turn)
{
    uvec3 parts = (uvec3(bits, bits >> 9, bits >> 18) & 511u) << 4 | (uvec3(turn, turn >> 4, turn >> 8) & 15u);
    return (vec3(parts) - 4096.0) * powerOfTwo(int(bits >> 27) - 25);
}
vec4 orientationOfBits(uint xy, uint zw) { return normalize(vec4(unpackSnorm2x16(xy), unpackSnorm2x16(zw))); }

// What a row says, in the group's axes.
struct Row
{
    vec3 position;
    float age;
    float radius;
    vec4 color;
    vec3 velocity;
    float angle;
    float frame;
    vec4 orientation;
};

Row newerRow(int row)
{
    Row r;
    r.position = newerVector(0, row);
    r.frame = newerPlace(10) >= 0 ? newerValue(10, row) : 0.0;
    r.velocity = vec3(0.0);
    r.angle = 0.0;
    r.orientation = vec4(0.0, 0.0, 0.0, 1.0);
    if (newerIsPacked()) {
        uint sizes = newerBits(3, row);
        uint high = newerBits(5, row);
        uint turn = high >> 9 & 0xFFFu;
        bool hasAngle = newerPlace(9) >= 0;
        r.radius = radiusOfBits(sizes);
        r.age = ageOfBits(high);
        r.color = colorOfBits(sizes, newerBits(4, row), high);
        if (newerPlace(6) >= 0)
            r.velocity = velocityOfBits(newerBits(6, row), hasAngle ? 0u : turn);
        r.angle = hasAngle ? float(turn) * kTurnUnit : 0.0;
        if (newerPlace(11) >= 0)
            r.orientation = orientationOfBits(newerBits(11, row), newerBits(12, row));
        return r;
    }
    r.age = newerValue(3, row);
    r.radius = newerValue(4, row);
    r.color = newerColor(5, row);
    if (newerPlace(6) >= 0)
        r.velocity = newerVector(6, row);
    if (newerPlace(9) >= 0)
        r.angle = newerValue(9, row);
    if (newerPlace(11) >= 0)
        r.orientation = vec4(newerVector(11, row), newerValue(14, row));
    return r;
}

// Columns that are not there are as in the newer.
Row olderRow(int row, Row newer)
{
    Row r = newer;
    r.position = olderVector(0, row);
    if (olderPlace(10) >= 0)
        r.frame = olderValue(10, row);
    if (olderIsPacked()) {
        uint sizes = olderBits(3, row);
        uint high = olderBits(5, row);
        uint turn = high >> 9 & 0xFFFu;
        bool hasAngle = olderPlace(9) >= 0;
        r.radius = radiusOfBits(sizes);
        r.age = ageOfBits(high);
        r.color = colorOfBits(sizes, olderBits(4, row), high);
        if (olderPlace(6) >= 0)
            r.velocity = velocityOfBits(olderBits(6, row), hasAngle ? 0u : turn);
        if (hasAngle)
            r.angle = float(turn) * kTurnUnit;
        if (olderPlace(11) >= 0)
            r.orientation = orientationOfBits(olderBits(11, row), olderBits(12, row));
    } else {
        r.age = olderValue(3, row);
        r.radius = olderValue(4, row);
        r.color = olderColor(5, row);
        if (olderPlace(6) >= 0)
            r.velocity = olderVector(6, row);
        if (olderPlace(9) >= 0)
            r.angle = olderValue(9, row);
        if (olderPlace(11) >= 0)
            r.orientation = vec4(olderVector(11, row), olderValue(14, row));
    }
    if (newerIsPacked() || olderIsPacked()) // whole turns are not told
        r.angle += 6.28318531 * round((newer.angle - r.angle) / 6.28318531);
    return r;
}

// Whether two rows are the same particle; ages of packed ones are rounded down, and go no further than one second.
bool isSame(Row older, Row newer, bool isPacked)
{
    float since = moment.y;
    float most = isPacked ? kMaxAge : 3.0e38;
    float least = isPacked ? min(floor(since / kAgeUnit) * kAgeUnit, most) : since;
    float room = 0.5 * since + (isPacked ? 1.5 * kAgeUnit : 0.0);
    return newer.age >= least && older.radius > 0.0 && abs(min(older.age + since, most) - newer.age) < room;
}

// A row that lives in both snapshots is mixed of both; one that was born between them is carried back along its velocity.
Particle fetchParticle(int row)
{
    Particle p;
    Row newer = newerRow(row);
    bool isPacked = newerIsPacked();
    float back = (1.0 - moment.x) * moment.y;
    bool isBorn = isPacked ? newer.age + kAgeUnit > back || newer.age >= kMaxAge : newer.age >= back;
    bool both = false;
#ifdef FX_MARKS
    vec3 local = newer.velocity;
    p.turned = vec2(newer.angle);
    p.oriented[0] = p.oriented[1] = newer.orientation;
#endif
    if (moment.z > 0.5 && row < rows.y) {
        Row older = olderRow(row, newer);
        both = isSame(older, newer, isPacked || olderIsPacked());
        if (both) {
            float t = moment.x;
            vec4 now = newer.orientation;
#ifdef FX_MARKS
            local = (newer.position - older.position) / moment.y;
            p.turned.x = older.angle;
            p.oriented[0] = older.orientation;
#endif
            newer.position = mix(older.position, newer.position, t);
            newer.radius = mix(older.radius, newer.radius, t);
            newer.velocity = mix(older.velocity, newer.velocity, t);
            newer.color = mix(older.color, newer.color, t);
            newer.angle = mix(older.angle, newer.angle, t);
            if (older.frame <= newer.frame) // otherwise it began anew
                newer.frame = mix(older.frame, newer.frame, t);
            if (newerPlace(11) >= 0 && olderPlace(11) >= 0)
                newer.orientation =
                    normalize(mix(dot(older.orientation, now) < 0.0 ? -older.orientation : older.orientation, now, t));
        }
    }
    p.alive = newer.radius > 0.0 && (both || moment.z < 0.5 || isBorn);
    if (!both && moment.z > 0.5)
        newer.position -= newer.velocity * back;
    p.center = placed(newer.position);
#ifdef FX_MARKS
    p.drift = placedDirection(local) + driftAt(vec4(newer.position, 1.0));
#endif
    p.velocity = placedDirection(newer.velocity);
    p.radius = newer.radius * placePosition.w;
    p.color = newer.color;
    p.angle = newer.angle;
    p.frame = newer.frame;
    p.orientation = newer.orientation;
    return p;
}
