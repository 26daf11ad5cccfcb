{
 "cells": [{"cell_type": "code", "source": ["routine = SysIdRoutine()"], "outputs": []}],
 "nbformat": 4
}
