/* The quota of processors that control groups leave a process: the least of its group and of those around it. */
#include "base/platform.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <cmocka.h>

static char root[] = "/tmp/motus-groups-XXXXXX";

static void folder(const char *name)
{
    char path[200];
    snprintf(path, sizeof path, "%s%s", root, name);
    mkdir(path, 0700);
}

static void file(const char *name, const char *text)
{
    char path[200];
    snprintf(path, sizeof path, "%s%s", root, name);
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
}

static long quota(const char *groups)
{
    char path[200];
    file("/groups", groups);
    snprintf(path, sizeof path, "%s/groups", root);
    return platform_quota(path, root);
}

static void version_2(void **state)
{
    (void)state;
    folder("/a"), folder("/a/b"), folder("/a/b/c");
    assert_int_equal(quota("0::/a/b/c\n"), 0);
    file("/a/b/c/cpu.max", "max 100000\n");
    assert_int_equal(quota("0::/a/b/c\n"), 0);
    file("/a/b/cpu.max", "400000 100000\n");
    assert_int_equal(quota("0::/a/b/c\n"), 4);
    file("/a/cpu.max", "150000 100000\n");
    assert_int_equal(quota("0::/a/b/c\n"), 2); /* rounded up */
    file("/a/b/c/cpu.max", "1000 100000\n");
    assert_int_equal(quota("0::/a/b/c\n"), 1);
    assert_int_equal(quota("0::/\n"), 0);
    file("/cpu.max", "300000 100000\n");
    assert_int_equal(quota("0::/\n"), 3);
    assert_int_equal(quota("0::/a group/that is not seen here\n"), 3);
    file("/cpu.max", "");
}

static void version_1(void **state)
{
    (void)state;
    folder("/cpu"), folder("/cpu/a");
    file("/cpu/a/cpu.cfs_quota_us", "-1\n"), file("/cpu/a/cpu.cfs_period_us", "100000\n");
    assert_int_equal(quota("4:memory:/a\n3:cpu,cpuacct:/a\n"), 0);
    file("/cpu/a/cpu.cfs_quota_us", "250000\n");
    assert_int_equal(quota("4:memory:/a\n3:cpu,cpuacct:/a\n"), 3);
    assert_int_equal(quota("4:memory:/a\n3:cpuset:/a\n"), 0);
}

static void of_this_process(void **state)
{
    (void)state;
    assert_true(platform_processors() >= 1);
    assert_int_equal(quota(""), 0);
    assert_int_equal(platform_quota("/nowhere", "/nowhere"), 0);
}

int main(void)
{
    if (!mkdtemp(root)) return 1;
    const struct CMUnitTest tests[] = {cmocka_unit_test(version_2), cmocka_unit_test(version_1),
                                       cmocka_unit_test(of_this_process)};
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    char command[60];
    snprintf(command, sizeof command, "rm -r '%s'", root);
    return system(command) == 0 ? failed : 1;
}
