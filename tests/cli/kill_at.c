/* Preloaded into the program under test: kills its whole process group at the KILL_AT-th write, fsync or rename of a file in KILL_FOLDER.
   KILL_WHEN is "before", "half" (of a write) or "after". */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/uio.h>
#include <unistd.h>

static long* calls; /* shared with child processes */

__attribute__((constructor)) static void begin(void) {
    calls = mmap(NULL, sizeof *calls, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
}

static int is_ours(const char* path) {
    const char* folder = getenv("KILL_FOLDER");
    return folder != NULL && strncmp(path, folder, strlen(folder)) == 0;
}

static int is_our_descriptor(int descriptor) {
    char link[64];
    char path[PATH_MAX];
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(link, path, sizeof path - 1);
    path[length > 0 ? length : 0] = '\0';
    return is_ours(path);
}

static void die(void) {
    kill(0, SIGKILL);
}

/* 'b', 'h' or 'a' when this is the call to die at, otherwise 0. */
static int fate(void) {
    const char* at = getenv("KILL_AT");
    const char* when = getenv("KILL_WHEN");
    return at != NULL && when != NULL && __sync_add_and_fetch(calls, 1) == atol(at) ? when[0] : 0;
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int descriptor, const void* bytes, size_t size) {
    const int end = is_our_descriptor(descriptor) ? fate() : 0;
    if (end == 'b') {
        die();
    }
    const ssize_t done = NEXT(write)(descriptor, bytes, end == 'h' ? size / 2 : size);
    if (end != 0) {
        die();
    }
    return done;
}

/* Half of these buffers is the first of them. */
ssize_t writev(int descriptor, const struct iovec* buffers, int count) {
    const int end = is_our_descriptor(descriptor) ? fate() : 0;
    if (end == 'b') {
        die();
    }
    const ssize_t done = NEXT(writev)(descriptor, buffers, end == 'h' ? 1 : count);
    if (end != 0) {
        die();
    }
    return done;
}

int fsync(int descriptor) {
    const int end = is_our_descriptor(descriptor) ? fate() : 0;
    if (end == 'b') {
        die();
    }
    const int done = NEXT(fsync)(descriptor);
    if (end != 0) {
        die();
    }
    return done;
}

int rename(const char* from, const char* to) {
    const int end = is_ours(to) || to[0] != '/' ? fate() : 0;
    if (end == 'b') {
        die();
    }
    const int done = NEXT(rename)(from, to);
    if (end != 0) {
        die();
    }
    return done;
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned int flags) {
    const int end = is_ours(to) || to[0] != '/' ? fate() : 0;
    if (end == 'b') {
        die();
    }
    const int done = NEXT(renameat2)(from_folder, from, to_folder, to, flags);
    if (end != 0) {
        die();
    }
    return done;
}
