// Curves over life and speed and colors of particles, as simulation/particles/motion_lanes-inl.h and color_lanes-inl.h have them.
// FX_LIFE_TABLE, FX_SPEED_TABLE 1: curves are samples, else lines piece by piece.

// Between two samples of a table, or on the line of a piece.
float curveBetween(float first, float second, float place, bool isTable)
{
    precise float value = first + place * (isTable ? second - first : second);
    return value;
}
float curveOfLife(int channel, float place, int piece)
{
    int at = channel * kCurveSamples + piece;
    return curveBetween(lifeCurves[at], lifeCurves[at + (FX_LIFE_TABLE == 1 ? 1 : kCurvePieces)], place, FX_LIFE_TABLE == 1);
}
float curveOfSpeed(int channel, float place, int piece)
{
    int at = channel * kCurveSamples + piece;
    return curveBetween(speedCurves[at], speedCurves[at + (FX_SPEED_TABLE == 1 ? 1 : kCurvePieces)], place, FX_SPEED_TABLE == 1);
}
// Which piece of a curve `t` is in, and how far. All channels have the same pieces.
float tablePlaceOf(float t, out int piece)
{
    precise float s = clamp(t, 0.0, 1.0) * 64.0;
    piece = min(int(s), 63);
    precise float place = s - float(piece);
    return place;
}
float placeInLife(float t, out int piece)
{
#if FX_LIFE_TABLE
    return tablePlaceOf(t, piece);
#else
    piece = 0;
    for (int k = 1; k < kCurvePieces; ++k)
        piece += t >= lifeCurves[2 * kCurvePieces + k] ? 1 : 0;
    return t;
#endif
}
float placeInSpeed(float t, out int piece)
{
#if FX_SPEED_TABLE
    return tablePlaceOf(t, piece);
#else
    piece = 0;
    for (int k = 1; k < kCurvePieces; ++k)
        piece += t >= speedCurves[2 * kCurvePieces + k] ? 1 : 0;
    return t;
#endif
}

// half-floats, (1) and (2); what packHalf2x16 rounds to is up to the driver
uint halfOf(float x)
{
    float bounded = min(max(x, 0.0), 65504.0);
    uint bits = floatBitsToUint(bounded);
    precise float lifted = bounded + 0.5;
    if (bounded < 6.103515625e-5)
        return floatBitsToUint(lifted) - (126u << 23);
    return (bits - (112u << 23) + 0xFFFu + ((bits >> 13) & 1u)) >> 13;
}
