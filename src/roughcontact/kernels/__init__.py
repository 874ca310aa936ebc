"""Loops in machine code: written here in a small language, translated once by LLVM, kept on disk."""
