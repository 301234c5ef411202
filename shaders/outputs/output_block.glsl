// The frame before, within a view; filled in rendering/outputs/output_pass.cpp.
//
// pastRight, pastUp, pastForward  camera axes in world; w: clip x and clip y per unit of slope, flip of window y
// pastClip                        xy clip position of the view axis; z 1 orthographic; w seconds since then
// pastEye                         xyz [m] the eye then, relative to the eye now; w 1 when solid things are marked
#define FX_VIEW_EXTRA \
    vec4 pastRight; \
    vec4 pastUp; \
    vec4 pastForward; \
    vec4 pastClip; \
    vec4 pastEye;
