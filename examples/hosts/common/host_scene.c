#include "host_scene.h"

#include <epoxy/gl.h>

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

const float kHostEye[3] = {0.0f, 2.4f, 9.0f};
const float kHostTarget[3] = {0.0f, 1.3f, 0.0f};
const float kHostSky[3] = {0.05f, 0.07f, 0.12f};

static const float kNear = 0.1f;           /* [m] */
static const float kExposureEv100 = 11.0f; /* dusk, between the previews of a campfire and an explosion */
static const float kPaper[3] = {0.34f, 0.27f, 0.19f}; /* exposed light of white paper that faces the sun */
static const float kSun[3] = {-0.64f, 0.48f, 0.6f};   /* towards the sun */

const char* const kHostShadeGlsl = "vec3 hostShade(vec3 albedo, vec3 normal)\n"
                                   "{\n"
                                   "    float facing = max(dot(normal, vec3(-0.64, 0.48, 0.6)), 0.0);\n"
                                   "    vec3 sky = vec3(0.05, 0.07, 0.12) * (0.5 + 0.5 * normal.y);\n"
                                   "    return albedo * (vec3(0.34, 0.27, 0.19) * facing + sky);\n"
                                   "}\n";

const char* const kHostToneMapGlsl =
    "vec3 hostToneMap(vec3 light)\n"
    "{\n"
    "    const float white = 8.0, gray = 0.18;\n"
    "    light = clamp(light, 0.0, white);\n"
    "    float peak = max(max(light.r, light.g), light.b);\n"
    "    light += 0.22 * peak / white * ((light.r + light.g + light.b) / 3.0 - light);\n"
    "    vec3 t = max(light - gray, 0.0) / (1.0 - gray);\n"
    "    const float w = (white - gray) / (1.0 - gray);\n"
    "    vec3 y = min(light, gray) + (1.0 - gray) * t * (1.0 + t / (w * w)) / (1.0 + t);\n"
    "    return mix(12.92 * y, 1.055 * pow(max(y, 1e-6), vec3(1.0 / 2.4)) - 0.055, greaterThan(y, "
    "vec3(0.0031308)));\n"
    "}\n";

const char* const kHostFullScreenGlsl =
    "void main()\n"
    "{\n"
    "    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n"
    "}\n";

const char* const kHostVertexGlsl = "layout(location = 0) in vec3 positionIn;\n"
                                    "layout(location = 1) in vec3 normalIn;\n"
                                    "layout(location = 2) in vec3 albedoIn;\n"
                                    "layout(location = 0) uniform mat4 camera;\n"
                                    "out vec3 normal;\n"
                                    "out vec3 albedo;\n"
                                    "void main()\n"
                                    "{\n"
                                    "    normal = normalIn;\n"
                                    "    albedo = albedoIn;\n"
                                    "    gl_Position = camera * vec4(positionIn, 1.0);\n"
                                    "}\n";

/* A box from its lowest to its highest corner. @return vertices written */
static int addBox(HostVertex* out, const float low[3], const float high[3], const float albedo[3])
{
    int count = 0;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2, isHigh = side % 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        static const int corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
        for (int i = 0; i < 6; ++i) {
            HostVertex* vertex = &out[count++];
            const int isU = corners[i][isHigh ? 0 : 1], isV = corners[i][isHigh ? 1 : 0];
            memset(vertex, 0, sizeof *vertex);
            vertex->position[axis] = isHigh ? high[axis] : low[axis];
            vertex->position[u] = isU ? high[u] : low[u];
            vertex->position[v] = isV ? high[v] : low[v];
            vertex->normal[axis] = isHigh ? 1.0f : -1.0f;
            memcpy(vertex->albedo, albedo, sizeof vertex->albedo);
        }
    }
    return count;
}

int hostSceneVertices(HostVertex* outVertices)
{
    static const struct
    {
        float low[3], high[3], albedo[3];
    } boxes[] = {{{-60.0f, -0.5f, -80.0f}, {60.0f, 0.0f, 12.0f}, {0.26f, 0.25f, 0.22f}}, /* the ground */
                 {{-3.1f, 0.0f, 0.9f}, {-2.5f, 0.7f, 1.4f}, {0.60f, 0.25f, 0.14f}}, /* before the campfire */
                 {{-4.6f, 0.0f, -3.0f}, {-3.2f, 1.6f, -1.8f}, {0.30f, 0.45f, 0.62f}}, /* behind it */
                 {{0.9f, 0.0f, 0.2f}, {1.7f, 1.1f, 1.0f}, {0.60f, 0.55f, 0.25f}}, /* before the explosion */
                 {{3.6f, 0.0f, -3.2f}, {5.2f, 2.6f, -2.0f}, {0.60f, 0.60f, 0.62f}},
                 {{-0.5f, 0.0f, -14.0f}, {1.5f, 4.5f, -12.0f}, {0.45f, 0.40f, 0.36f}}};
    int count = 0;
    for (size_t i = 0; i < sizeof boxes / sizeof boxes[0]; ++i)
        count += addBox(outVertices + count, boxes[i].low, boxes[i].high, boxes[i].albedo);
    return count;
}

void hostCamera(float aspect, int isReversed, float outView[16], float outProjection[16])
{
    /* The eye looks along z = (eye - target) / length, and lies in the plane x = 0. */
    const float dy = kHostEye[1] - kHostTarget[1], dz = kHostEye[2] - kHostTarget[2];
    const float length = sqrtf(dy * dy + dz * dz), sine = dy / length, cosine = dz / length;
    const float view[16] = {1,
                            0,
                            0,
                            0,
                            0,
                            cosine,
                            sine,
                            0,
                            0,
                            -sine,
                            cosine,
                            0,
                            -kHostEye[0],
                            -cosine * kHostEye[1] + sine * kHostEye[2],
                            -sine * kHostEye[1] - cosine * kHostEye[2],
                            1};
    const float cotangent = 1.0f / tanf(0.5f * 3.14159265f / 180.0f * (float)HOST_FIELD_OF_VIEW);
    memcpy(outView, view, sizeof view);
    memset(outProjection, 0, 16 * sizeof(float));
    outProjection[0] = cotangent / aspect;
    outProjection[5] = cotangent;
    outProjection[10] = isReversed ? 0.0f : -1.0f;
    outProjection[11] = -1.0f;
    outProjection[14] = isReversed ? kNear : -2.0f * kNear;
}

FxViewSettings hostLight(void)
{
    FxViewSettings settings = fxDefaultViewSettings();
    const float unit = 1.2f * exp2f(kExposureEv100); /* [cd/m2] luminance that is stored as 1 */
    settings.exposureEv100 = kExposureEv100;
    settings.groundAlbedo = 0.25f;
    for (int i = 0; i < 3; ++i) {
        settings.sunDirection[i] = kSun[i];
        settings.sunIlluminance[i] = 3.14159265f * kPaper[i] * unit;
        settings.skyLuminance[i] = kHostSky[i] * unit;
    }
    return settings;
}

static int compile(unsigned program, GLenum kind, const char* common, const char* text)
{
    const char* texts[3] = {"#version 450 core\n", common, text};
    const GLuint shader = glCreateShader(kind);
    GLint isCompiled = 0;
    glShaderSource(shader, 3, texts, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &isCompiled);
    if (!isCompiled) {
        char log[1024] = "";
        glGetShaderInfoLog(shader, sizeof log, NULL, log);
        fprintf(stderr, "a shader of the host does not compile: %s\n", log);
    }
    glAttachShader(program, shader);
    glDeleteShader(shader);
    return isCompiled;
}

unsigned hostMakeProgram(const char* vertex, const char* common, const char* fragment)
{
    const GLuint program = glCreateProgram();
    GLint isLinked = 0;
    if (!compile(program, GL_VERTEX_SHADER, "", vertex) ||
        !compile(program, GL_FRAGMENT_SHADER, common, fragment))
        return 0;
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &isLinked);
    if (!isLinked)
        fprintf(stderr, "a program of the host does not link\n");
    return isLinked ? program : 0;
}

unsigned hostMakeMesh(int* outVertexCount)
{
    static HostVertex vertices[HOST_VERTEX_CAPACITY];
    static const size_t offsets[3] = {offsetof(HostVertex, position), offsetof(HostVertex, normal),
                                      offsetof(HostVertex, albedo)};
    GLuint array, buffer;
    *outVertexCount = hostSceneVertices(vertices);
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, *outVertexCount * (GLsizeiptr)sizeof(HostVertex), vertices, 0);
    glCreateVertexArrays(1, &array);
    glVertexArrayVertexBuffer(array, 0, buffer, 0, sizeof(HostVertex));
    for (GLuint i = 0; i < 3; ++i) {
        glEnableVertexArrayAttrib(array, i);
        glVertexArrayAttribFormat(array, i, 3, GL_FLOAT, GL_FALSE, (GLuint)offsets[i]);
        glVertexArrayAttribBinding(array, i, 0);
    }
    return array;
}

void hostMultiply(const float a[16], const float b[16], float out[16])
{
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) {
            float sum = 0.0f;
            for (int k = 0; k < 4; ++k)
                sum += a[4 * k + row] * b[4 * column + k];
            out[4 * column + row] = sum;
        }
}
