// Where and whereto particles are born, as simulation/particles/birth_lanes.cpp and shapes/ have it. FX_SHAPE GpuShape; FX_TURNED 1: about
// another axis than +Y; FX_WIDE 1: in double precision.

// Sine and cosine of a birth's angle: shapes of simulation/particles/shapes/ have them in double precision.
vec2 azimuthOf(float turns)
{
#if FX_WIDE
    return vec2(sinCosTurnsWide(double(turns)));
#else
    return sinCosTurns(turns);
#endif
}

// (1) of birth-shapes, given sine and cosine of the azimuth
vec3 aroundY(float u1, float limit, vec2 azimuth)
{
    precise float cosine = 1.0 - u1 * (1.0 - limit);
    precise float squared = max((1.0 - cosine) * (1.0 + cosine), 0.0);
    precise float sine = sqrt(squared);
    precise vec3 direction = vec3(sine * azimuth.y, cosine, sine * azimuth.x);
    return direction;
}
vec3 coneDirection(float u1, float u2, float limit) { return aroundY(u1, limit, azimuthOf(u2)); }

// even-shapes, (2)
float discRadius(float u)
{
    precise float squared = inner * inner + u * (1.0 - inner * inner);
    return sqrt(squared);
}
vec3 onCircle(float turns)
{
    vec2 azimuth = azimuthOf(turns);
    return vec3(azimuth.y, 0.0, azimuth.x);
}

const vec3 kUp = vec3(0.0, 1.0, 0.0);

// Around the origin, along +Y.
void bearUpright(uvec2 index, out vec3 place, out vec3 direction)
{
    place = vec3(0.0);
#if FX_SHAPE != 0
    vec4 u = drawn(index, kPosition);
#endif
#if FX_SHAPE == 0 || FX_SHAPE == 3 || FX_SHAPE == 5
    vec4 heading = drawn(index, kDirection);
#endif
#if FX_SHAPE == 0
    direction = coneDirection(heading.x, heading.y, -1.0);
#elif FX_SHAPE == 1
    direction = coneDirection(u.x, u.y, -1.0);
#if FX_WIDE
    double k1 = double(inner);
    precise double k = k1 * k1 * k1;
    precise double share = k + double(u.z) * (1.0lf - k);
    precise float r = size[0] * float(cubeRootWide(share));
#else
    precise float k = inner * inner * inner;
    precise float r = size[0] * cubeRoot(k + u.z * (1.0 - k));
#endif
    precise vec3 there = r * direction;
    place = there;
#elif FX_SHAPE == 2
    direction = kUp;
    precise vec3 there = vec3(size[0], size[1], size[2]) * (u.xyz + u.xyz - 1.0);
    place = there;
#elif FX_SHAPE == 3
    direction = coneDirection(heading.x, heading.y, cosLimit);
    precise float r = size[0] * discRadius(u.y);
    precise vec3 there = r * onCircle(u.x);
    place = there;
#elif FX_SHAPE == 4
    vec3 extents = vec3(size[0], size[1], size[2]);
    precise vec3 area = extents.yzx * extents.zxy;
    precise float sum = area.x + area.y + area.z;
    precise float pick = 2.0 * u.w * sum; // (6) of even-shapes
    float side = pick < sum ? 1.0 : -1.0;
    precise float rest = pick < sum ? pick : pick - sum;
    precise float two = area.x + area.y;
    int face = rest < area.x ? 0 : (rest < two ? 1 : 2);
    precise vec3 there = extents * (2.0 * u.xyz - 1.0);
    place = there;
    place[face] = side * extents[face];
    direction = vec3(0.0);
    direction[face] = side;
#elif FX_SHAPE == 5
    precise float along = size[0] * (2.0 * u.x - 1.0);
    place = along * kUp;
    direction = onCircle(heading.x);
#elif FX_SHAPE == 6
    direction = kUp;
    precise vec3 there = size[0] * discRadius(u.y) * onCircle(u.x);
    place = there;
#elif FX_SHAPE == 7
    precise float r = tube * discRadius(u.z); // (5) of even-shapes
    vec2 around = azimuthOf(u.y);
    precise float lean = size[0] > 0.0 ? r / size[0] : 0.0;
    precise float inward = 0.5 * (1.0 - lean * around.y);
    float cosine = u.w < inward ? 0.0 - around.y : around.y; // (4)
    vec3 outward = onCircle(u.x);
    precise vec3 leaning = cosine * outward + around.x * kUp;
    precise vec3 there = size[0] * outward + r * leaning;
    direction = leaning;
    place = there;
#else
    precise double slope = double(coneSlope[0]) + double(coneSlope[1]) + double(coneSlope[2]);
    double low = double(size[0]);
    precise double high = low + double(coneHeight) * slope;
    precise double z = double(u.y) * double(coneHeight);
    precise double wide = low;
    precise float tip = 0.0; // below the disc
    bool widens = slope > 1e-6lf;
    if (widens) { // (3) of even-shapes
        precise double square = low * low + double(u.y) * (high * high - low * low);
        precise double cube = low * low * low + double(u.y) * (high * high * high - low * low * low);
        wide = tube > 0.0 ? sqrt(square) : cubeRootWide(cube);
        z = (wide - low) / slope;
        tip = float(low / slope);
    }
    precise float r = float(wide) * discRadius(u.z);
    precise vec3 there = r * onCircle(u.x) + vec3(0.0, float(z), 0.0);
    precise vec3 away = widens ? there + vec3(0.0, tip, 0.0) : kUp;
    float distance = lengthOf(away);
    precise vec3 unit = away / distance;
    place = there;
    direction = distance > 0.0 ? unit : kUp;
#endif
}

void bear(uvec2 index, out vec3 x, out vec3 direction)
{
    vec3 place;
    bearUpright(index, place, direction);
#if FX_TURNED
    vec3 upright = vec3(axis[0], axis[1], axis[2]);
    place = turnFromY(upright, place);
    direction = turnFromY(upright, direction);
#endif
    precise vec3 there = place + vec3(position[0], position[1], position[2]);
    x = there;
}
