/// @file host_scene.h
/// What a game has of its own, the same for all example hosts: ground and boxes, a camera, light, a curve.
///
/// Threads: the GL thread. Lengths are meters, +Y is up. Colors are linear Rec. 709, exposed: 1 is stored as
/// 1.
#ifndef HOST_SCENE_H
#define HOST_SCENE_H

#include "fxsdk/fx_view.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct HostVertex
{
    float position[3];
    float normal[3];
    float albedo[3];
} HostVertex;

/// Triangles of the ground and the boxes, counterclockwise from outside.
/// @param outVertices room for HOST_VERTEX_CAPACITY vertices @return number of vertices
int hostSceneVertices(HostVertex* outVertices);

enum
{
    HOST_VERTEX_CAPACITY = 512
};

/// The place of the eye and where it looks. [m]
extern const float kHostEye[3];
extern const float kHostTarget[3];

enum
{
    HOST_FIELD_OF_VIEW = 50 ///< [degree] vertical
};

/// Matrices of the camera, column-major, right-handed, infinite far plane.
/// @param aspect     width / height
/// @param isReversed 1: near maps to 1 and infinity to 0 in [0, 1]; 0: to -1 and 1
void hostCamera(float aspect, int isReversed, float outView[16], float outProjection[16]);

/// View settings with the exposure and the light of the scene.
FxViewSettings hostLight(void);

/// The color behind the scene.
extern const float kHostSky[3];

/// GLSL of `vec3 hostShade(vec3 albedo, vec3 normal)`: exposed light that a surface reflects.
extern const char* const kHostShadeGlsl;

/// GLSL of `vec3 hostToneMap(vec3 light)`: exposed light to sRGB codes. It is the curve of
/// FxViewSettings::toneMap with the white 8. A game has its own curve.
extern const char* const kHostToneMapGlsl;

/// GLSL of a vertex shader whose three vertices cover the picture.
extern const char* const kHostFullScreenGlsl;

/// GLSL of a vertex shader of the scene: locations 0, 1, 2 are the members of HostVertex; uniform 0 is
/// projection times view. Outputs are `normal` and `albedo`.
extern const char* const kHostVertexGlsl;

/// Compiles and links a program. Each text follows `#version 450 core`; the fragment shader is `common`
/// followed by `fragment`. @return GL name; 0 after printing the log
unsigned hostMakeProgram(const char* vertex, const char* common, const char* fragment);

/// Uploads the triangles into a vertex array for kHostVertexGlsl. @return GL name of the vertex array
unsigned hostMakeMesh(int* outVertexCount);

/// out = a b, all column-major.
void hostMultiply(const float a[16], const float b[16], float out[16]);

#ifdef __cplusplus
}
#endif

#endif
