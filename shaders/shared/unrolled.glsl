// A statement for each of some numbers. Software renderers (Mesa's) end all loops of an invocation after 65,535 turns in all: those
// of inner loops count, those of unrolled ones do not. See kMaxLoopTurns of rendering/compositions/slabs/slab_passes.h.
#define FX_EACH_3(statement) statement(0) statement(1) statement(2)
#define FX_EACH_4(statement) FX_EACH_3(statement) statement(3)
#define FX_EACH_6(statement) FX_EACH_4(statement) statement(4) statement(5)
#define FX_EACH_8(statement) FX_EACH_6(statement) statement(6) statement(7)
#define FX_EACH_16(statement)                                                                              \
    FX_EACH_8(statement) statement(8) statement(9) statement(10) statement(11) statement(12) statement(13) \
    statement(14) statement(15)
