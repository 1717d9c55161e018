# A container with the package built and ready to use. test/on_debian.sh runs the RUN lines, one line each, in a bare Debian.
#
#   docker build --tag lstm_planner .
#   docker run --rm -it lstm_planner                   # a shell with everything sourced
#   docker run --rm lstm_planner bash launch/demo.sh  # the demo
FROM debian:13
ENV LANG=C.UTF-8 HOME=/root
COPY . /lstm_planner
WORKDIR /lstm_planner
RUN apt-get update
RUN bash launch/demo.sh
RUN bash test/run.sh --build-only
CMD ["bash", "--rcfile", "/root/.cache/lstm_planner/devel/setup.bash"]
