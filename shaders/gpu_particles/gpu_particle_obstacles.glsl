// Planes, balls and boxes: distance of a position, contact of a leg, and which particles need the full test.
// Part of gpu_particle_contacts.glsl, whose legs and answers these functions share; formula swept-contact.

double dotOf(dvec3 a, dvec3 b)
{
    precise dvec3 products = a * b;
    precise double sum = products.x + products.y + products.z;
    return sum;
}

vec3 turnToY(vec3 a, vec3 v) { return turnFromY(vec3(-a.x, a.y, -a.z), v); }

vec3 unitOrUp(vec3 v)
{
    float size = lengthOf(v);
    precise vec3 unit = v / size;
    return size > 0.0 ? unit : vec3(0.0, 1.0, 0.0);
}

float largestOf(vec3 v) { return max(v.x, max(v.y, v.z)); }
int largestAxis(vec3 v) { return v.x >= v.y ? (v.x >= v.z ? 0 : 2) : (v.y >= v.z ? 1 : 2); }

float liftAt(vec3 p)
{
    precise float lifted = largestOf(abs(p)) * 9.5367431640625e-7; // 2^-20
    return max(lifted, 1e-6);
}

bool isThere(int kind) { return kind != kGround || stepGround() > -1e30; }
int responseAt(int kind, int n) { return n + (kind == kSphere ? 5 : (kind == kBox ? 11 : (kind == kDepth ? 2 : 7))); }

// Planes: normal, offset in three parts, margin
double offsetOf(int kind, int n)
{
    precise double offset = kind == kGround ? double(stepGround()) + double(moduleNumbers[n + 6])
                                            : (double(moduleNumbers[n + 3]) + double(moduleNumbers[n + 4])) + double(moduleNumbers[n + 5]);
    return offset;
}

// ---- how far a place is from matter ----

float clearanceOf(int kind, int n, vec3 p, out vec3 normal)
{
    if (kind == kPlane || kind == kGround) {
        normal = numbersAt(n);
        precise double distance = dotOf(dvec3(normal), dvec3(p)) - offsetOf(kind, n);
        return float(distance);
    }
    if (kind == kSphere) { // center, radius, -1: matter is outside
        precise vec3 away = p - numbersAt(n);
        float side = moduleNumbers[n + 4];
        precise float distance = side * (lengthOf(away) - moduleNumbers[n + 3]);
        normal = side * unitOrUp(away);
        return distance;
    }
    // Boxes: center, axis, half extents, 1: hollow, radius of the outline
    precise vec3 shifted = p - numbersAt(n);
    vec3 m = turnToY(numbersAt(n + 3), shifted);
    precise vec3 q = abs(m) - numbersAt(n + 6);
    vec3 outer = max(q, vec3(0.0));
    float outside = lengthOf(outer);
    int axis = largestAxis(q);
    vec3 face = vec3(axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0);
    precise vec3 size = outside > 0.0 ? outer / outside : face;
    float side = moduleNumbers[n + 9] > 0.0 ? -1.0 : 1.0;
    normal = turnFromY(numbersAt(n + 3), side * mix(size, -size, lessThan(m, vec3(0.0))));
    return side * (outside > 0.0 ? outside : largestOf(q));
}

void push(int kind, int n)
{
    vec3 normal;
    float distance = clearanceOf(kind, n, pushed, normal);
    if (!isThere(kind) || !(distance < 0.0))
        return;
    pushed = pushed + (liftAt(pushed) - distance) * normal;
    isOut = false;
}
void askInside(int kind, int n)
{
    vec3 normal;
    if (isThere(kind) && clearanceOf(kind, n, pushed, normal) < 0.0)
        isOut = false;
}

// Moves `pushed` out of matter; isOut tells whether that is done.
void pushOut()
{
    isOut = false;
    for (int k = 0; k < kMaxPushOuts && !isOut; ++k) {
        isOut = true;
        FX_PUSH
    }
    if (!isOut) {
        isOut = true;
        FX_INSIDE
    }
}

// ---- swept-contact ----

void meetAt(int kind, int n, float share, vec3 place, vec3 normal)
{
    if (metAt >= 0 && !(share < metShare))
        return;
    metAt = responseAt(kind, n);
    metShare = share;
    metPlace = place;
    metNormal = normal;
}

void meetPlane(int kind, int n)
{
    vec3 normal = numbersAt(n);
    dvec3 wide = dvec3(normal);
    precise double d = dotOf(wide, dvec3(legFrom)) - offsetOf(kind, n);
    double v = dotOf(wide, dvec3(legV));
    precise double a = 0.5lf * dotOf(wide, dvec3(legA));
    precise double time = 0.0lf;
    if (d > 0.0lf || v > 0.0lf || (v == 0.0lf && a >= 0.0lf)) { // (1)
        double high = max(d, 0.0lf);
        precise double inside = v * v - 4.0lf * a * high;
        if (inside < 0.0lf || (v >= 0.0lf && a >= 0.0lf))
            return;
        double root = sqrt(inside);
        time = v < 0.0lf ? 2.0lf * high / (root - v) : (v + root) / (-2.0lf * a);
        if (!(time <= double(legSeconds)))
            return;
    }
    precise double share = time / double(legSeconds);
    float t = float(time);
    precise vec3 place = legFrom + t * (legV + 0.5 * t * legA);
    meetAt(kind, n, min(float(share), 1.0), place, normal);
}

void meetSphere(int n)
{
    precise dvec3 m = dvec3(legFrom) - dvec3(numbersAt(n));
    precise dvec3 w = dvec3(legTo) - dvec3(legFrom);
    double radius = double(moduleNumbers[n + 3]);
    double side = double(moduleNumbers[n + 4]);
    double ww = dotOf(w, w);
    double mw = dotOf(m, w);
    double size = sqrt(dotOf(m, m));
    precise double c = (size - radius) * (size + radius);
    precise double inside = mw * mw - ww * c;
    bool isIn = side * c <= 0.0lf;
    if (!(ww > 0.0lf) || (isIn && side * mw >= 0.0lf))
        return;
    precise double s = 0.0lf;
    if (!isIn) {
        if (inside < 0.0lf || (side > 0.0lf && mw >= 0.0lf))
            return;
        s = side > 0.0lf ? c / (sqrt(inside) - mw) : (sqrt(inside) - mw) / ww; // (2)
        if (!(s <= 1.0lf))
            return;
    }
    precise dvec3 there = dvec3(legFrom) + s * w;
    vec3 place = vec3(there);
    precise vec3 away = place - numbersAt(n);
    meetAt(kSphere, n, float(s), place, moduleNumbers[n + 4] * unitOrUp(away));
}

void meetBox(int n)
{
    double infinity = packDouble2x32(uvec2(0u, 0x7FF00000u));
    precise vec3 fromHere = legFrom - numbersAt(n);
    precise vec3 toHere = legTo - numbersAt(n);
    vec3 axis = numbersAt(n + 3);
    vec3 from = turnToY(axis, fromHere);
    vec3 to = turnToY(axis, toHere);
    double enter = -infinity;
    double leave = infinity;
    int enterAxis = 0;
    int leaveAxis = 0;
    for (int k = 0; k < 3; ++k) { // (3)
        double m = double(from[k]);
        precise double w = double(to[k]) - m;
        double h = double(moduleNumbers[n + 6 + k]);
        if (w == 0.0lf) {
            if (abs(m) > h)
                return;
            continue;
        }
        precise double first = ((w > 0.0lf ? -h : h) - m) / w;
        precise double last = ((w > 0.0lf ? h : -h) - m) / w;
        if (first > enter) {
            enter = first;
            enterAxis = k;
        }
        if (last < leave) {
            leave = last;
            leaveAxis = k;
        }
    }
    bool isHollow = moduleNumbers[n + 9] > 0.0;
    precise double s = isHollow ? leave : enter;
    int face = isHollow ? leaveAxis : enterAxis;
    bool isMet = isHollow ? enter <= leave : (enter < leave && leave > 0.0lf);
    precise vec3 way = to - from;
    precise double slack = 1e-6lf + 1e-6lf * double(largestOf(abs(legFrom)));
    if (!isMet || !(s <= 1.0lf) || (!isHollow && s * double(lengthOf(way)) < -slack))
        return;
    float side = way[face] > 0.0 ? -1.0 : 1.0;
    vec3 normal = vec3(face == 0 ? side : 0.0, face == 1 ? side : 0.0, face == 2 ? side : 0.0);
    double share = min(max(s, 0.0lf), 1.0lf);
    precise dvec3 place = dvec3(legFrom) + share * (dvec3(legTo) - dvec3(legFrom));
    meetAt(kBox, n, float(share), vec3(place), turnFromY(axis, normal));
}

void meet(int kind, int n)
{
    if (!isThere(kind))
        return;
    if (kind == kSphere)
        meetSphere(n);
    else if (kind == kBox)
        meetBox(n);
    else
        meetPlane(kind, n);
}

// ---- which particles need the full test ----

vec3 ballCenter = vec3(0.0);
float ballRadius = 0.0;
bool isNear = false;

void findBall()
{
    precise vec3 way = atX - fromX;
    precise vec3 sag = atV * atSeconds - way;
    precise vec3 middle = (fromX + atX) * 0.5;
    precise float slack = lengthOf(middle) * 1e-5 + 1e-4;
    precise float radius = lengthOf(way) * 0.5001 + lengthOf(sag) * 0.2501 + slack;
    ballCenter = middle;
    ballRadius = radius;
    isNear = false;
}

void askNear(int kind, int n)
{
    precise float distance;
    if (kind == kPlane || kind == kGround) {
        distance = dotOf(ballCenter, numbersAt(n)) - float(offsetOf(kind, n));
    } else {
        precise vec3 away = ballCenter - numbersAt(n);
        distance = lengthOf(away) - moduleNumbers[n + (kind == kSphere ? 3 : 10)];
        bool isHollow = kind == kSphere ? moduleNumbers[n + 4] < 0.0 : moduleNumbers[n + 9] > 0.0;
        distance = isHollow ? -distance : distance;
    }
    if (isThere(kind) && distance <= ballRadius)
        isNear = true;
}
