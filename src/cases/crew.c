#include "cases/crew.h"

#include <math.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/mem.h"

enum { CELLS = 4096, HANDS = 16, NOTE = 1024 };

struct record { // of one cell, in memory that all processes share
    atomic_bool put;
    struct sb_outcome outcome; // its note apart
    char note[NOTE];
};
struct shared {
    atomic_int next;
    atomic_int at[HANDS + 1]; // the cell that each has taken; the last is this process
    struct record record[CELLS];
};

struct sb_crew {
    struct shared *shared;
    pid_t pid[HANDS]; // 0: ended
    int hands, self;
    bool *got; // a cell
};

// Memory without a name: the file is gone once nobody has it mapped.
static struct shared *share(void)
{
    FILE *file = tmpfile();
    void *memory = MAP_FAILED;
    if (file && ftruncate(fileno(file), sizeof(struct shared)) == 0)
        memory = mmap(NULL, sizeof(struct shared), PROT_READ | PROT_WRITE, MAP_SHARED,
                      fileno(file), 0);
    if (file)
        fclose(file);
    return memory == MAP_FAILED ? NULL : memory;
}

struct sb_crew *sb_crew_start(int hands, void (*work)(void *user, struct sb_crew *crew),
                              void *user)
{
    if (hands < 1)
        return NULL;
    struct shared *shared = share();
    if (!shared)
        return NULL;
    struct sb_crew *crew = sb_alloc(sizeof *crew);
    crew->shared = shared;
    crew->got = sb_alloc(CELLS * sizeof *crew->got);
    for (int i = 0; i <= HANDS; i++)
        shared->at[i] = -1;
    fflush(NULL); // or each process would print it
    for (int i = 0; i < hands && i < HANDS; i++) {
        crew->self = i;
        const pid_t pid = fork();
        if (pid == 0) {
            work(user, crew);
            _exit(0);
        }
        if (pid < 0)
            break;
        crew->pid[crew->hands++] = pid;
    }
    crew->self = HANDS;
    return crew;
}

int sb_crew_take(struct sb_crew *crew)
{
    const int cell = atomic_fetch_add(&crew->shared->next, 1);
    crew->shared->at[crew->self] = cell < CELLS ? cell : -1;
    return cell;
}

void sb_crew_put(struct sb_crew *crew, int cell, const struct sb_outcome *outcome)
{
    struct record *record = &crew->shared->record[cell];
    record->outcome = *outcome;
    record->outcome.note = (struct sb_text){0};
    snprintf(record->note, sizeof record->note, "%s", sb_text_get(&outcome->note));
    atomic_store(&record->put, true);
    crew->shared->at[crew->self] = -1;
}

bool sb_crew_get(struct sb_crew *crew, int cell, struct sb_outcome *outcome)
{
    struct record *record = &crew->shared->record[cell];
    if (crew->got[cell] || !atomic_load(&record->put))
        return false;
    crew->got[cell] = true;
    *outcome = record->outcome;
    sb_text_add(&outcome->note, record->note);
    return true;
}

// A hand that ended in the middle of a cell.
static void bury(struct sb_crew *crew, int hand, int status)
{
    const int cell = crew->shared->at[hand];
    struct sb_outcome outcome = {
        .verdict = SB_VERDICT_FAIL, .measured = NAN, .bound = NAN, .point = -1};
    crew->pid[hand] = 0;
    if (cell < 0)
        return;
    if (WIFSIGNALED(status))
        sb_text_printf(&outcome.note, "the driver took the process down: %s",
                       strsignal(WTERMSIG(status)));
    else
        sb_text_printf(&outcome.note, "the process ended with %d", WEXITSTATUS(status));
    sb_crew_put(crew, cell, &outcome);
    sb_text_free(&outcome.note);
}

bool sb_crew_works(struct sb_crew *crew)
{
    bool works = false;
    for (int i = 0; i < crew->hands; i++) {
        int status;
        if (crew->pid[i] == 0)
            continue;
        if (waitpid(crew->pid[i], &status, WNOHANG) == crew->pid[i])
            bury(crew, i, status);
        else
            works = true;
    }
    return works;
}

void sb_crew_stop(struct sb_crew *crew)
{
    for (int i = 0; i < crew->hands; i++) {
        int status;
        if (crew->pid[i] == 0)
            continue;
        kill(crew->pid[i], SIGKILL);
        if (waitpid(crew->pid[i], &status, 0) == crew->pid[i])
            bury(crew, i, status);
    }
}

void sb_crew_end(struct sb_crew **crew)
{
    struct sb_crew *it = *crew;
    if (!it)
        return;
    sb_crew_stop(it);
    munmap(it->shared, sizeof *it->shared);
    free(it->got);
    free(it);
    *crew = NULL;
}
