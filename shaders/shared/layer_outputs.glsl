// The targets of the media pass where light is sorted by layer.
layout(location = 0) out vec4 fireLight;
layout(location = 1) out vec4 smokeLight;
layout(location = 2) out vec4 dustLight;
layout(location = 3) out vec4 coverage;    // rgb opacity seen of fire, smoke, dust; a of all
layout(location = 4) out vec4 depthMoment; // r distance weighted by seen opacity [m]; a blends
layout(location = 5) out vec4 opticalDepthSum;
