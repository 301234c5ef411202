// The commands of fx in the order of its help, and where they are.
FX_COMMAND(Render)     // fxsdk/cli/render
FX_COMMAND(Gallery)    // fxsdk/cli/gallery
FX_COMMAND(Export)     // fxsdk/cli/export
FX_COMMAND(Import)     // fxsdk/cli/import
FX_COMMAND(Edit)       // fxsdk/editor/program
FX_COMMAND(Link)       // fxsdk/cli/link
FX_COMMAND(Validate)   // fxsdk/cli/inspect
FX_COMMAND(Doctor)     // fxsdk/cli/inspect
FX_COMMAND(Parameters) // fxsdk/cli/inspect
FX_COMMAND(Verify)     // benchmarks/verify
FX_COMMAND(Accuracy)   // benchmarks/accuracy
FX_COMMAND(Stability)  // benchmarks/stability
FX_COMMAND(Dazzle)     // fxsdk/cli/dazzle
FX_COMMAND(Bench)      // benchmarks/bench
FX_COMMAND(Explain)    // fxsdk/cli/inspect
FX_COMMAND(Calibrate)  // benchmarks/calibrate
FX_COMMAND(Grid)       // fxsdk/cli/grid
