"""Experiments: demonstrations, trainings and evaluations as one pipeline that can be killed.

recipe              the command of `lerobot-train` for a policy and a dataset
study               options of a study: which policies learn which tasks, and how they are judged
experiment          several studies with one folder, as a value
parts/              what is done, one program each: recording, verification, cutting, training,
                    evaluation
planning            from an experiment to its parts, in order; refuses what cannot be done
requirements        inputs that stand, room on the disk, memory: before anything is done
part_record         what is kept of a part: its inputs, what it took, how it ended
rates               what parts took on this machine, and what others will take
warm_up             the same parts in small, to measure rates that nobody knows yet
child_process       one program in a process of its own, watched
part_launcher       where programs run: on this machine, or all over a Ray cluster (ray_parts)
runner              what is missing is done, what stands is left, what failed stops nothing else
training_kit        what trains elsewhere: recordings, recipes, packages and commands in a folder
kit_trainer         the program in that folder that trains
running_bars        what is done while it runs, and how long everything takes
measured            results as tables and curves: what is not measured says so
"""
