"""A program that violates the line protocol in the way that its command line names."""
import sys
import time

how = sys.argv[1]
answers = int(sys.argv[2]) if len(sys.argv) > 2 else 0  # the first answers, this many, are good
if how == "mute":
    sys.exit(0)
if how == "deaf":
    time.sleep(3600)
if how == "nameless":
    print("onlyaname", flush=True)
sys.stdin.readline()
print(f"hostile 1 {how}", flush=True)
for line in sys.stdin:
    if answers > 0:
        answers -= 1
        print("free", flush=True)
    elif how == "dies":
        sys.exit(3)
    elif how == "hangs":
        time.sleep(3600)
    elif how == "garbage":
        print("ouch: \xff NaN 0.5", flush=True)
    elif how == "silent":
        pass
    elif how == "chatty":
        print("free\nfree\nfree", flush=True)
    elif how == "endless":
        while True:
            sys.stdout.write("free " * 1000)
    elif how == "wrong-time":
        print("collision nan", flush=True)
    elif how == "orphan":
        import subprocess
        # The child process keeps the pipe open.
        subprocess.Popen([sys.executable, "-c", "import time; time.sleep(30)"])
        sys.exit(0)
    else:
        print(how, flush=True)
