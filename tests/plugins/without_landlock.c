/* Runs a command under a filter by which the system has no Landlock: what follows the program's name.
 * With -n before it, no new user namespaces either. */
#include <errno.h>
#include <linux/sched.h>
#include <seccomp.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

int main(int argc, char** argv) {
  const int no_namespaces = argc > 1 && strcmp(argv[1], "-n") == 0;
  if (argc < 2 + no_namespaces) return 2;
  scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
  seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(landlock_create_ruleset), 0);
  seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(landlock_add_rule), 0);
  seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(landlock_restrict_self), 0);
  if (no_namespaces) {
    seccomp_rule_add(filter, SCMP_ACT_ERRNO(EPERM), SCMP_SYS(unshare), 1,
                     SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_NEWUSER, CLONE_NEWUSER));
  }
  if (seccomp_load(filter) != 0) return 2;
  execv(argv[1 + no_namespaces], argv + 1 + no_namespaces);
  perror(argv[1 + no_namespaces]);
  return 2;
}
