// Preloaded before Oclgrind. LLVM's inliner marks where the arguments of inlined functions do not overlap by calls of
// llvm.experimental.noalias.scope.decl, which Oclgrind 21.10 takes for a function that is missing, and then it refuses
// the kernel. LLVM is told to leave the marks out. Nothing else of the program depends on them.
void LLVMParseCommandLineOptions(int count, const char *const *arguments, const char *overview);

__attribute__((constructor)) static void set_options(void)
{
    const char *const options[] = {"oclgrind", "-use-noalias-intrinsic-during-inlining=false"};
    LLVMParseCommandLineOptions(2, options, 0);
}
