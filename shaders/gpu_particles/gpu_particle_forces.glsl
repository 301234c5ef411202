// What moves particles whose motion has no closed form, operation by operation as simulation/particles/builtin_ops.cpp and
// simulation/particles/forces/ have it. Each function is a module: `n` is the place of its first number, `w` that of its first
// word within the step. Formulas are named where they stand in C++.

// The particle that is stepped, and the step.
precise vec3 atX = vec3(0.0);
precise vec3 atV = vec3(0.0);
float atSeconds = 0.0; // of its part of the step
float atLife = 0.0;    // [1] when it begins
uvec2 atIndex = uvec2(0u);
int stepAt = 0; // its first word
precise vec3 stepPull = vec3(0.0); // sums that modules add to
precise vec3 stepAir = vec3(0.0);
precise float stepQuadratic = 0.0;

float stepFloat(int at) { return uintBitsToFloat(stepWords[stepAt + at]); }
vec3 stepVector(int at) { return vec3(stepFloat(at), stepFloat(at + 1), stepFloat(at + 2)); }
vec3 numbersAt(int n) { return vec3(moduleNumbers[n], moduleNumbers[n + 1], moduleNumbers[n + 2]); }

void addGravity(int n, int w)
{
    precise vec3 more = moduleNumbers[n] * stepVector(4);
    stepPull = stepPull + more;
    stepAir = stepAir + stepVector(7);
}

// Numbers: gravity, buoyancy over the air's temperature, range of the excess temperature, 65 samples of its curve over life.
void addLift(int n, int w)
{
    precise float s = clamp(atLife, 0.0, 1.0) * 64.0;
    int i = min(int(s), 63);
    precise float f = s - float(i);
    float low = moduleNumbers[n + 4 + i];
    precise float share = low + f * (moduleNumbers[n + 5 + i] - low);
    precise float excess = ofRange(moduleNumbers[n + 2], moduleNumbers[n + 3], drawn(atIndex, kAttributes).z) * share;
    precise float weight = moduleNumbers[n] - moduleNumbers[n + 1] * excess;
    precise vec3 more = weight * stepVector(4);
    stepPull = stepPull + more;
    stepAir = stepAir + stepVector(7);
}

// ---- curl-noise; words: seed, gain, 1 / scale, 16 cosines, 16 sines ----

uint mixWord(uint x)
{
    x = (x ^ (x >> 16)) * 0x85EBCA6Bu;
    x = (x ^ (x >> 13)) * 0xC2B2AE35u;
    return x ^ (x >> 16);
}

vec3 componentsOf(uint word)
{
    precise vec3 c = vec3(uvec3(word, word >> 10, word >> 20) & 1023u) * (2.0 / 1023.0) - 1.0;
    return c;
}

struct NoiseCell
{
    ivec3 cell;
    vec3 f;
    vec3 fade; // of the upper border
    vec3 slope;
};

NoiseCell noiseCellOf(vec3 p)
{
    vec3 high = mix(vec3(1e9), p, lessThan(p, vec3(1e9)));
    vec3 bounded = mix(vec3(-1e9), high, greaterThan(p, vec3(-1e9)));
    vec3 low = floor(bounded);
    precise vec3 f = bounded - low;
    precise vec3 s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    precise vec3 ds = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    return NoiseCell(ivec3(low), f, s, ds);
}

void addCurl(int n, int w)
{
    uint seed = stepWords[stepAt + w];
    precise vec3 p = atX * stepFloat(w + 2);
    NoiseCell at = noiseCellOf(p);
    precise vec3 below = 1.0 - at.fade;
    precise vec3 slope0 = vec3(0.0);
    precise vec3 slope1 = vec3(0.0);
    precise vec3 slope2 = vec3(0.0);
    for (uint bits = 0u; bits < 8u; ++bits) {
        bvec3 b = bvec3((bits & 1u) != 0u, (bits & 2u) != 0u, (bits & 4u) != 0u);
        uvec3 corner = uvec3(at.cell) + uvec3(b);
        uint word = mixWord(seed + corner.x * 0x8DA6B343u + corner.y * 0xD8163841u + corner.z * 0xCB1AB31Fu);
        uint phase = word >> 30;
        word = mixWord(word + 0x9E3779B9u);
        vec3 g0 = componentsOf(word);
        phase = phase * 4u + (word >> 30);
        word = mixWord(word + 0x9E3779B9u);
        vec3 g1 = componentsOf(word);
        phase = phase * 4u + (word >> 30);
        word = mixWord(word + 0x9E3779B9u);
        vec3 g2 = componentsOf(word);
        phase = phase * 4u + (word >> 30);
        float c = stepFloat(w + 3 + int(phase & 15u));
        float s = stepFloat(w + 19 + int(phase & 15u));
        precise vec3 d = at.f - vec3(b);
        vec3 fade = mix(below, at.fade, b);
        vec3 ds = mix(-at.slope, at.slope, b);
        precise float weight = fade.x * fade.y * fade.z;
        precise vec3 dw = vec3(ds.x * fade.y * fade.z, fade.x * ds.y * fade.z, fade.x * fade.y * ds.z);
        precise vec3 h0 = c * g0 + s * g1; // (4)
        precise vec3 h1 = c * g1 + s * g2;
        precise vec3 h2 = c * g2 + s * g0;
        slope0 = slope0 + (dw * dotOf(h0, d) + weight * h0); // (2)
        slope1 = slope1 + (dw * dotOf(h1, d) + weight * h1);
        slope2 = slope2 + (dw * dotOf(h2, d) + weight * h2);
    }
    precise vec3 curl = vec3(slope2.y - slope1.z, slope0.z - slope2.x, slope1.x - slope0.y); // (3)
    stepAir = stepAir + curl * stepFloat(w + 1);
}

// ---- modules of the list ----

void addGust(int n, int w) { stepAir = stepAir + stepVector(w); }
void addQuadraticDrag(int n, int w) { stepQuadratic = stepQuadratic + moduleNumbers[n]; }

// vortex-air; numbers: center, axis, R^2, 2 R speed, 2 R pull, R^2 lift, -hold
void turnAround(int n, bool holds)
{
    vec3 axis = numbersAt(n + 3);
    precise vec3 way = atX - numbersAt(n);
    precise vec3 r = way - axis * dotOf(way, axis);
    vec3 t = crossOf(axis, r);
    float rr = dotOf(r, r);
    precise float part = 1.0 / (moduleNumbers[n + 6] + rr);
    precise vec3 air = t * (moduleNumbers[n + 7] * part); // (1)
    air = air - r * (moduleNumbers[n + 8] * part);
    air = air + axis * (moduleNumbers[n + 9] * part);
    stepAir = stepAir + air;
    if (!holds)
        return;
    precise float turning = dotOf(atV, t) / max(rr, 1e-12);
    precise float q = turning * atSeconds * 0.5;
    precise float pull = (turning * turning * moduleNumbers[n + 10]) / (1.0 + q * q);
    stepPull = stepPull + (r + t * q) * pull; // (2)
}
void addVortex(int n, int w) { turnAround(n, false); }
void addHoldingVortex(int n, int w) { turnAround(n, true); }

// attraction; numbers: center, softening^2, reach^2, strength with the power of the radius
void attract(int n, int falloff)
{
    precise vec3 d = numbersAt(n) - atX;
    float dd = dotOf(d, d);
    precise float soft = dd + moduleNumbers[n + 3];
    precise float slope = 1.0;
    if (falloff == 0)
        slope = 1.0 / sqrt(soft);
    else if (falloff == 1)
        slope = 1.0 / soft;
    else if (falloff == 2)
        slope = 1.0 / (soft * sqrt(soft));
    precise float share = dd <= moduleNumbers[n + 4] ? moduleNumbers[n + 5] * slope : 0.0; // (1)
    stepPull = stepPull + d * share;
}
void addSpring(int n, int w) { attract(n, -1); }
void addConstant(int n, int w) { attract(n, 0); }
void addInverse(int n, int w) { attract(n, 1); }
void addInverseSquare(int n, int w) { attract(n, 2); }

// trilinear-vectors; numbers: low, cells a meter, nodes, strength, and the vectors
vec3 fieldMix(vec3 a, vec3 b, float u)
{
    precise vec3 v = a + u * (b - a);
    return v;
}
vec3 fieldAt(int n)
{
    vec3 nodes = numbersAt(n + 6);
    precise vec3 g = (atX - numbersAt(n)) * numbersAt(n + 3); // (1)
    vec3 last = nodes - 1.0;
    bvec3 flatAxis = equal(nodes, vec3(1.0));
    vec3 bounded = mix(min(max(g, vec3(0.0)), last), vec3(0.0), flatAxis);
    vec3 cell = floor(min(bounded, max(nodes, vec3(2.0)) - 2.0));
    precise vec3 u = bounded - cell;
    bvec3 within = bvec3(uvec3(greaterThanEqual(g, vec3(0.0))) * uvec3(lessThanEqual(g, last)));
    if (!all(bvec3(uvec3(within) + uvec3(flatAxis))))
        return vec3(0.0);
    ivec3 stride = ivec3(3, 3 * int(nodes.x), 3 * int(nodes.x) * int(nodes.y));
    ivec3 low = ivec3(cell) * stride + ivec3(n + 10, 0, 0);
    ivec3 high = low + stride * ivec3(not(flatAxis));
    vec3 corners[4];
    for (int i = 0; i < 4; ++i) {
        int at = ((i & 1) == 0 ? low.y : high.y) + (i < 2 ? low.z : high.z);
        corners[i] = fieldMix(numbersAt(at + low.x), numbersAt(at + high.x), u.x);
    }
    vec3 v = fieldMix(fieldMix(corners[0], corners[1], u.y), fieldMix(corners[2], corners[3], u.y), u.z); // (2)
    precise vec3 field = v * moduleNumbers[n + 9];
    return field;
}
void addFieldAir(int n, int w) { stepAir = stepAir + fieldAt(n); }
void addFieldForce(int n, int w) { stepPull = stepPull + fieldAt(n); }

// conform-spring; numbers: center, size, distance kept, stiffness, damping, reach
void drawTo(int n, float distance, vec3 normal)
{
    float damping = moduleNumbers[n + 8];
    precise float d = distance - moduleNumbers[n + 6];
    precise float kt = moduleNumbers[n + 7] * atSeconds;
    precise float pull = moduleNumbers[n + 7] * d + (damping + kt) * dotOf(atV, normal); // (1)
    precise float part = 1.0 + (damping + kt) * atSeconds;
    precise float a = -(pull / part);
    precise float near = abs(d) <= moduleNumbers[n + 9] ? a : 0.0;
    stepPull = stepPull + normal * near;
}
void addConformSphere(int n, int w)
{
    precise vec3 p = atX - numbersAt(n);
    float size = lengthOf(p);
    precise float per = 1.0 / max(size, 1e-12);
    precise vec3 normal = p * per;
    precise float distance = size - moduleNumbers[n + 3];
    drawTo(n, distance, normal);
}
void addConformBox(int n, int w)
{
    precise vec3 p = atX - numbersAt(n);
    precise vec3 q = abs(p) - numbersAt(n + 3);
    vec3 outer = max(q, vec3(0.0));
    float outside = lengthOf(outer);
    float most = max(q.x, max(q.y, q.z));
    precise float per = 1.0 / max(outside, 1e-12);
    // Inside, the nearest face; of equally near ones the first.
    vec3 face = q.x == most ? vec3(1.0, 0.0, 0.0) : (q.y == most ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0));
    precise vec3 size = outside > 0.0 ? outer * per : face;
    vec3 normal = mix(size, -size, lessThan(p, vec3(0.0)));
    precise float distance = outside + min(most, 0.0);
    drawTo(n, distance, normal);
}

// ---- tile-motion ----

// (2): what half the quadratic drag leaves of the velocity relative to the air
void brake(float halfTime)
{
    precise vec3 w = atV - stepAir;
    precise float keep = 1.0 / (1.0 + stepQuadratic * lengthOf(w) * halfTime);
    atV = stepAir + w * keep;
}

void integrate()
{
    Drag step = dragOf(atSeconds);
    precise float halfTime = 0.5 * atSeconds;
    precise vec3 pull = stepPull + drag * stepAir;
    if (stepQuadratic > 0.0)
        brake(halfTime);
    atX = atX + step.gain * atV + step.ramp * pull; // (3)
    atV = step.decay * atV + step.gain * pull;
    if (stepQuadratic > 0.0)
        brake(halfTime);
}
