"""For GLIBC_TUNABLES: the same functions of the C library on every processor."""

SAME_EVERYWHERE = ":".join(
    [
        "glibc.cpu.hwcaps=-AVX,-AVX2,-AVX512F,-AVX512VL,-ERMS,-FSRM,-FMA,-FMA4,-AVX_Fast_Unaligned_Load",
        "glibc.cpu.x86_data_cache_size=32768",
        "glibc.cpu.x86_shared_cache_size=1048576",
        "glibc.cpu.x86_non_temporal_threshold=1048576",
        "glibc.malloc.arena_max=1",
    ]
)
