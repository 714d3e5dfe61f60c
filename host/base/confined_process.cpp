#include "base/confined_process.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace wrinkle {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;
#endif

/// Forbidden whatever their arguments. Those of older architectures' only are behind their names.
constexpr long kForbidden[] = {
    SYS_execve,
    SYS_execveat,
    SYS_socket,
    SYS_socketpair,
    SYS_connect,
    SYS_bind,
    SYS_ptrace,
    SYS_unlinkat,
    SYS_mkdirat,
    SYS_linkat,
    SYS_symlinkat,
    SYS_renameat2,
    SYS_fchmodat,
    SYS_fchownat,
    SYS_mknodat,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_truncate,
    SYS_mount,
    SYS_keyctl,
    SYS_bpf,
    SYS_io_uring_setup,
    SYS_userfaultfd,
    SYS_openat2,
#ifdef SYS_rename
    SYS_unlink,
    SYS_rename,
    SYS_mkdir,
    SYS_rmdir,
    SYS_link,
    SYS_symlink,
    SYS_chmod,
    SYS_chown,
    SYS_creat,
    SYS_mknod,
    SYS_lchown,
#endif
#ifdef SYS_renameat
    SYS_renameat,
#endif
};

sock_filter load(std::size_t offset) { return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)); }

/// What a program of the filter does next where the loaded number is `value`: it goes on, else it leaves out
/// `otherwise` instructions.
sock_filter if_equal(std::uint32_t value, std::uint8_t otherwise) {
    return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, otherwise);
}

constexpr sock_filter kRefuse = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM);
constexpr sock_filter kAllow = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
constexpr sock_filter kEnd = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);

/// Refuses the call `number` where its argument has a flag that opens to write.
void refuse_writing(std::vector<sock_filter>& program, long number, std::size_t argument) {
    constexpr std::uint32_t writes = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
    program.push_back(if_equal(static_cast<std::uint32_t>(number), 4));
    program.push_back(load(offsetof(seccomp_data, args) + argument * sizeof(std::uint64_t)));
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, writes, 0, 1));
    program.push_back(kRefuse);
    program.push_back(kAllow);
}

}  // namespace

bool confine_process() {
    if (kArchitecture == 0) return false;
    std::vector<sock_filter> program{load(offsetof(seccomp_data, arch)),
                                     BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0), kEnd,
                                     load(offsetof(seccomp_data, nr))};
#ifdef __x86_64__
    constexpr std::uint32_t other_numbers = 0x40000000;  // of x32, which would be ways around
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, other_numbers, 0, 1));
    program.push_back(kEnd);
#endif
    for (const long number : kForbidden) {
        program.push_back(if_equal(static_cast<std::uint32_t>(number), 1));
        program.push_back(kRefuse);
    }
    refuse_writing(program, SYS_openat, 2);
#ifdef SYS_open
    refuse_writing(program, SYS_open, 1);
#endif
    program.push_back(kAllow);
    const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

}  // namespace wrinkle
