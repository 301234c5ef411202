// A ball as the samples of a field hold it. Needs formulas/kernel_optical_depth.fx.h, formulas/voxel_kernel.fx.h,
// shared/blob_instance.glsl and field/field_blocks.glsl.
struct FieldBall
{
    vec3 center; // [m]
    float perRadius2; // [1/m2]
    float fineness;   // of the formula voxel-kernel
    float peak;       // [1/m] extinction in the center, without undoing the blur
    vec4 emitted;     // rgb [exposed]; a 1
    vec4 scattering;  // rgb albedo; a mean cosine
#if FX_LAYERS
    vec4 share; // see field_sample.glsl
#endif
};

FieldBall fieldBall(VoxelField field, uint number)
{
    vec4 place = blobs[number].centerRadius;
    float radius = max(place.w, field.limits.x);
    FieldBall ball;
    ball.center = place.xyz;
    ball.perRadius2 = 1.0 / (radius * radius);
    ball.fineness = field.corner.w * field.corner.w * ball.perRadius2;
    ball.peak = fxKernelPeak(blobs[number].medium.x, radius);
    ball.emitted = vec4(blobs[number].emission.rgb, 1.0);
    ball.scattering = blobs[number].scatter;
#if FX_LAYERS
    float layerShare = blobs[number].layer.x;
    float layer = floor(layerShare * 0.5);
    float fire = layer < 0.5 ? 1.0 : layerShare - 2.0 * layer;
    bool isDust = layer > 1.5;
    ball.share = vec4(fire, isDust ? 1.0 - fire : 0.0, layer < 0.5, isDust);
#endif
    return ball;
}

// [1/m]
float extinctionAt(FieldBall ball, vec3 place)
{
    vec3 d = place - ball.center;
    return ball.peak * fxVoxelKernel(dot(d, d) * ball.perRadius2, ball.fineness);
}
