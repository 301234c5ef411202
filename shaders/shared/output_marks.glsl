// What the outputs of a view need to know of whatever it shows, besides its light. Layouts are asserted in
// rendering/passes/output_marks.h.
struct BlobMark
{
    vec4 velocity; // xyz [m/s] relative to the world
    uvec4 instance; // xy its id, low word first
};
// Of a fragment of a card, beside its node of shared/card_nodes.glsl.
struct CardMark
{
    vec4 velocity;  // xyz [m/s] relative to the world; w opacity, also where it only adds
    uvec4 instance; // xy its id, low word first
};
