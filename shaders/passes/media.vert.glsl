#include "shared/view_block.glsl"
#include "shared/blob_instance.glsl"
#include "shared/blob_quad.glsl"

// One covering rectangle a blob; the fragment gets the blob unchanged.
flat out vec4 blobCenterRadius;
flat out vec4 blobMedium;
flat out vec4 blobSun;
flat out vec4 blobSky;
flat out vec4 blobEmission;

void main()
{
    BlobInstance blob = blobs[gl_InstanceID];
    blobCenterRadius = blob.centerRadius;
    blobMedium = blob.medium;
    blobSun = blob.sun;
    blobSky = blob.sky;
    blobEmission = blob.emission;
    gl_Position = blobQuadCorner(blob.centerRadius.xyz, blob.centerRadius.w, gl_VertexID);
}
