"""`python -m paintlink`: the command line."""

from paintlink.cli import main

if __name__ == "__main__":
    main()
