// Random numbers and elementary functions of particles, operation by operation as simulation/particles/birth_lanes.cpp and
// lanes-inl.h have them. `precise` forbids to fuse what C++ rounds twice.

// philox4x32-10
uvec4 philox(uvec4 counter, uvec2 key)
{
    for (int i = 0; i < 10; ++i) {
        uint high0, low0, high1, low1;
        umulExtended(0xD2511F53u, counter.x, high0, low0);
        umulExtended(0xCD9E8D57u, counter.z, high1, low1);
        counter = uvec4(high1 ^ counter.y ^ key.x, low1, high0 ^ counter.w ^ key.y, low0);
        key += uvec2(0x9E3779B9u, 0xBB67AE85u);
    }
    return counter;
}

// [1] in [0, 1)
vec4 unitFloats(uvec4 words) { return vec4(words >> 8) * 5.9604644775390625e-8; }

float ofRange(float low, float high, float u)
{
    precise float value = low + (high - low) * u;
    return value;
}

// e^-z for z >= 0; (4) of drag-coefficients
float expMinus(float z)
{
    precise float bounded = min(z, 87.0);
    precise float n = (bounded * 1.44269504 + 12582912.0) - 12582912.0;
    precise float r = (n * 0.693359375 - bounded) - n * 2.12194440e-4;
    precise float r2 = r * r;
    precise float p0 = 1.0 + r;
    precise float p1 = 0.5 + 0.166666672 * r;
    precise float p2 = 0.0416666679 + 0.00833333377 * r;
    precise float p3 = 0.00138888892 + 0.000198412701 * r;
    precise float sum = (p0 + r2 * p1) + (r2 * r2) * (p2 + r2 * p3);
    precise float result = sum * intBitsToFloat((127 - int(n)) << 23);
    return result;
}

// Sine (x) and cosine (y) of t turns.
vec2 sinCosTurns(float t)
{
    precise float q = (t * 4.0 + 12582912.0) - 12582912.0;
    precise float a = (t - q * 0.25) * 6.28318531;
    precise float z = a * a;
    precise float s = -0.000198412701;
    s = s * z + 0.00833333377;
    s = s * z - 0.166666672;
    s = a + a * z * s;
    precise float c = 2.48015876e-5;
    c = c * z - 0.00138888892;
    c = c * z + 0.0416666679;
    c = c * z - 0.5;
    c = c * z + 1.0;
    int quarter = int(q);
    bool odd = (quarter & 1) == 1;
    float sine = odd ? c : s;
    float cosine = odd ? s : c;
    return vec2((quarter & 2) != 0 ? -sine : sine, ((quarter + 1) & 2) != 0 ? -cosine : cosine);
}

// (2) of birth-lanes
float cubeRoot(float u)
{
    precise float bits = float(floatBitsToInt(u)) * 0.333333343;
    precise float y = intBitsToFloat(int(bits) + 709921077);
    for (int i = 0; i < 2; ++i) {
        precise float cube = y * y * y;
        y = y * ((cube + u + u) / (cube + cube + u));
    }
    return u > 0.0 ? y : 0.0;
}

// ---- vectors ----

float dotOf(vec3 a, vec3 b)
{
    precise vec3 products = a * b;
    precise float sum = products.x + products.y + products.z;
    return sum;
}
float lengthOf(vec3 a) { return sqrt(dotOf(a, a)); }
vec3 crossOf(vec3 a, vec3 b)
{
    precise vec3 c = vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    return c;
}

// shortest-turn
vec3 turnFromY(vec3 a, vec3 v)
{
    precise float squared = a.x * a.x + a.z * a.z;
    if (a.y < 0.0 && squared < 1e-12)
        return vec3(v.x, -v.y, -v.z);
    if (squared == 0.0)
        return v;
    vec3 w = vec3(a.z, 0.0, -a.x);
    vec3 once = crossOf(w, v);
    precise vec3 turned = v + once + crossOf(w, once) / (1.0 + a.y); // (1)
    return turned;
}

// ---- in double precision, as foundation/math/elementary.h has them ----

// sine-cosine-of-turns
dvec2 sinCosTurnsWide(double t)
{
    precise double part = t - floor(t + 0.5lf);
    precise double q = floor(4.0lf * part + 0.5lf);
    precise double a = 6.283185307179586476925lf * (part - 0.25lf * q);
    precise double z = a * a;
    precise double s = -1.0lf / 1307674368000.0lf;
    s = s * z + 1.0lf / 6227020800.0lf;
    s = s * z - 1.0lf / 39916800.0lf;
    s = s * z + 1.0lf / 362880.0lf;
    s = s * z - 1.0lf / 5040.0lf;
    s = s * z + 1.0lf / 120.0lf;
    s = s * z - 1.0lf / 6.0lf;
    s = a + a * z * s;
    precise double c = 1.0lf / 20922789888000.0lf;
    c = c * z - 1.0lf / 87178291200.0lf;
    c = c * z + 1.0lf / 479001600.0lf;
    c = c * z - 1.0lf / 3628800.0lf;
    c = c * z + 1.0lf / 40320.0lf;
    c = c * z - 1.0lf / 720.0lf;
    c = c * z + 1.0lf / 24.0lf;
    c = c * z - 0.5lf;
    c = c * z + 1.0lf;
    int quarter = int(q) & 3;
    double sine = (quarter & 1) != 0 ? c : s;
    double cosine = (quarter & 1) != 0 ? s : c;
    return dvec2((quarter & 2) != 0 ? -sine : sine, quarter == 1 || quarter == 2 ? -cosine : cosine);
}

// cube-root, for x >= 0
double cubeRootWide(double x)
{
    if (!(x >= 1e-300lf))
        return 0.0lf;
    uvec2 bits = unpackDouble2x32(x); // a third of them, and 0x2A9F7893782DA1CE
    uint rest = bits.y % 3u;
    uint low = rest * 0x55555555u + bits.x / 3u + (bits.x % 3u + rest) / 3u;
    uint carry;
    low = uaddCarry(low, 0x782DA1CEu, carry);
    precise double y = packDouble2x32(uvec2(low, bits.y / 3u + 0x2A9F7893u + carry));
    for (int i = 0; i < 3; ++i) {
        precise double cube = y * y * y;
        y = y * ((cube + 2.0lf * x) / (2.0lf * cube + x));
    }
    return y;
}
